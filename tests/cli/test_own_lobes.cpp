// --lobe and --strategy FILE.cl: a user's own kernel files.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "own_lobe.h"
#include "temporary_folder.h"

using Catch::Contains;

namespace {

// A sphere in constant light, with a material of the given type.
std::string scene_of(const std::string& bsdf) {
  return R"(<scene version="0.6.0">
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film>
<transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0" up="0,1,0"/></transform></sensor>
<shape type="sphere">)" +
         bsdf + R"(</shape>
<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
</scene>)";
}

Outcome render(const TemporaryFolder& folder, std::vector<std::string> options) {
  std::vector<std::string> arguments{"render", "scene.xml", "-n", "4", "-o", "a.exr", "--png", "none"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run({arguments, folder.path(), {}, {}});
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const char* const minnaert = R"(<bsdf type="minnaert"><float name="exponent" value="1"/></bsdf>)";

// Samples directions by the cosine.
const char* const plain_strategy =
    R"(static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated, Real lobe) {
  return larger(generated.z, (Real)(0.0f)) * INV_PI;
}
static inline LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Vec3 direction = polar_direction(sqrt(1.0f - uniform_real(random.words.y)), sqrt(uniform_real(random.words.y)),
                                         uniform_real(random.words.z));
  LobeValue v;
  v.value = phong_value(m, phong_lobe(m, fixed, direction));
  v.density = v.reverse = direction.z * INV_PI;
  return lobe_sample(direction, v);
}
static inline Real phong_survival(Phong m, Vec3 fixed, RandomDraws random) {
  return vec_max(phong_reflectivity(m, fixed));
}
)";

} // namespace

TEST_CASE("phlux render --lobe: a scene names a model of the user's own") {
  const TemporaryFolder folder;
  folder.write("scene.xml", scene_of(minnaert));
  folder.write("minnaert.cl", minnaert_text);
  CHECK(render(folder, {"--lobe", "minnaert.cl"}).exit_code == 0);

  const Outcome without = render(folder, {});
  CHECK(without.exit_code == 3);
  CHECK(without.is_one_line_error());
  CHECK_THAT(without.err, Contains("scene.xml:4") && Contains("--lobe NAME.cl adds a model of your own"));

  folder.write("scene.xml", scene_of(R"(<bsdf type="minnaert"><float name="exponent" value="101"/></bsdf>)"));
  CHECK_THAT(render(folder, {"--lobe", "minnaert.cl"}).err, Contains("exponent must be in [0, 100]"));
}

TEST_CASE("phlux render --lobe: compiler errors name the user's file and line") {
  const TemporaryFolder folder;
  folder.write("scene.xml", scene_of(minnaert));
  std::filesystem::create_directory(folder / "my lobes");
  folder.write("my lobes/minnaert.cl", replaced(minnaert_text, "v.density = minnaert_density(m, generated.z)",
                                                "v.density = minnaert_density(m, generated.w)"));
  const Outcome wrong = render(folder, {"-q", "--lobe", "my lobes/minnaert.cl"});
  CHECK(wrong.exit_code == 3);
  CHECK(wrong.is_one_line_error());
  CHECK_THAT(wrong.err, Contains("my lobes/minnaert.cl:19: "));

  folder.write("minnaert.cl", replaced(minnaert_text, "Vec3 minnaert_reflectivity", "Vec3 reflectivity"));
  CHECK_THAT(render(folder, {"--lobe", "minnaert.cl"}).err,
             Contains("there is no function minnaert_reflectivity"));
  CHECK(render(folder, {"--lobe", "none.cl"}).exit_code == 3);
  CHECK(render(folder, {"--lobe", "Minnaert.cl"}).is_one_line_error());
}

TEST_CASE("phlux render --lobe: a checkpoint resumes only with the same model") {
  const TemporaryFolder folder;
  folder.write("scene.xml", scene_of(minnaert));
  folder.write("minnaert.cl", minnaert_text);
  REQUIRE(render(folder, {"--lobe", "minnaert.cl", "--checkpoint", "c.ckpt"}).exit_code == 0);
  const std::vector<std::string> more{"render", "scene.xml", "-n",   "8",        "-o",
                                      "b.exr",  "--png",     "none", "--resume", "c.ckpt"};
  const Outcome without = run({more, folder.path(), {}, {}});
  CHECK(without.exit_code == 3);
  CHECK_THAT(without.err, Contains("--lobe NAME.cl"));
  std::vector<std::string> with = more;
  with.insert(with.end(), {"--lobe", "minnaert.cl"});
  CHECK(run({with, folder.path(), {}, {}}).exit_code == 0);
  folder.write("minnaert.cl", replaced(minnaert_text, "NO_LANES", "NO_LANES "));
  CHECK_THAT(run({with, folder.path(), {}, {}}).err, Contains("is of another scene"));
}

TEST_CASE("phlux render --strategy FILE.cl: a strategy of the user's own") {
  const TemporaryFolder folder;
  folder.write("scene.xml", scene_of(R"(<bsdf type="phong"/>)"));
  folder.write("plain.cl", plain_strategy);
  REQUIRE(
      render(folder, {"--strategy", "plain.cl", "--stats", "s.json", "--checkpoint", "c.ckpt"}).exit_code ==
      0);
  CHECK(nlohmann::json::parse(TemporaryFolder::read(folder / "s.json")).at("strategy") == "plain.cl");

  const Outcome resumed =
      run({{"render", "scene.xml", "-n", "8", "--resume", "c.ckpt"}, folder.path(), {}, {}});
  CHECK(resumed.exit_code == 2);
  CHECK_THAT(resumed.err, Contains("give --strategy plain.cl too"));
  const std::vector<std::string> more = {"render",   "scene.xml", "-n",         "8",
                                         "--resume", "c.ckpt",    "--strategy", "plain.cl"};
  CHECK(run({more, folder.path(), {}, {}}).exit_code == 0);
  folder.write("plain.cl", plain_strategy + std::string("// changed\n"));
  const Outcome changed = run({more, folder.path(), {}, {}});
  CHECK(changed.exit_code == 3);
  CHECK_THAT(changed.err, Contains("c.ckpt: is of a render with another plain.cl"));

  folder.write("plain.cl",
               replaced(plain_strategy, "vec_max(phong_reflectivity", "vec_most(phong_reflectivity"));
  const Outcome wrong = render(folder, {"--strategy", "plain.cl"});
  CHECK(wrong.exit_code == 3);
  CHECK_THAT(wrong.err, Contains("plain.cl:13: "));
  folder.write("plain.cl", "#include \"nowhere.h\"\n");
  const Outcome without = render(folder, {"--strategy", "plain.cl"});
  CHECK(without.exit_code == 3);
  CHECK_THAT(without.err, Contains("plain.cl:1: "));
  folder.write("plain.cl", "");
  const Outcome empty = render(folder, {"--strategy", "plain.cl"});
  CHECK(empty.exit_code == 3);
  CHECK(empty.is_one_line_error());
  CHECK_THAT(empty.err, Contains("plain.cl: does not define phong_density: a strategy defines"));
  const Outcome missing = render(folder, {"--strategy", "none.cl"});
  CHECK(missing.exit_code == 2);
  CHECK_THAT(missing.err, Contains("--strategy none.cl: cannot be read"));
}

TEST_CASE("phlux verify --lobe: what passes, and which function contradicts which") {
  const TemporaryFolder folder;
  folder.write("minnaert.cl", minnaert_text);
  const Outcome right =
      run({{"verify", "--quick", "--lobe", "minnaert.cl", "--set", "exponent=5", "--json", "v.json"},
           folder.path(),
           {},
           {}});
  CHECK(right.exit_code == 0);
  CHECK_THAT(right.out, Contains("reciprocity") && Contains("passed: "));
  CHECK(nlohmann::json::parse(TemporaryFolder::read(folder / "v.json")).at("conclusions").empty());

  folder.write("minnaert.cl", replaced(minnaert_text, "cosine_power_direction(m.exponent + 1.0f,",
                                       "cosine_power_direction(m.exponent,"));
  const Outcome wrong = run({{"verify", "--quick", "--lobe", "minnaert.cl"}, folder.path(), {}, {}});
  CHECK(wrong.exit_code == 1);
  CHECK_THAT(wrong.out, Contains("FAILED minnaert directions: minnaert_sample's directions do not follow "
                                 "minnaert_evaluate's density: one of them is wrong: "));
}

TEST_CASE("phlux verify --strategy FILE.cl, --model and --set: usage") {
  const TemporaryFolder folder;
  folder.write("plain.cl", plain_strategy);
  const Outcome own = run({{"verify", "--quick", "--strategy", "plain.cl"}, folder.path(), {}, {}});
  CHECK(own.exit_code == 0);
  CHECK_THAT(own.out, Contains("phong by plain.cl"));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"verify", "--set", "exponent=3"},
                                                    {"verify", "--model", "fong"},
                                                    {"verify", "--model", "phong", "--set", "exponent=-1"},
                                                    {"verify", "--model", "phong", "--set", "gloss=1"},
                                                    {"verify", "--strategy", "none.cl"}}) {
    CAPTURE(arguments.back());
    const Outcome outcome = run({arguments, folder.path(), {}, {}});
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.is_one_line_error());
  }
}

TEST_CASE(
    "The strategy that the page on the Phong model shows is a file that passes verify and bench sampling") {
  const std::filesystem::path file = std::filesystem::path(PHLUX_SOURCE_DIR) / "scenes/lobes/half-uniform.cl";
  CHECK_THAT(TemporaryFolder::read(PHLUX_SOURCE_DIR "/kernels/phong/README.md"),
             Contains("```c\n" + TemporaryFolder::read(file) + "```\n"));
  const TemporaryFolder folder;
  const Outcome verified = run({{"verify", "--quick", "--strategy", file.string()}, folder.path(), {}, {}});
  CAPTURE(verified.out, verified.err);
  CHECK(verified.exit_code == 0);
  folder.write("own.cl", TemporaryFolder::read(file));
  const Outcome measured =
      run({{"bench", "sampling", "--out", ".", "--samples", "20000", "--strategy", "own.cl", "--strategy",
            "cosine", "--case", ".4,.4,10,60", "--integrand", "constant"},
           folder.path(),
           {},
           {}});
  CAPTURE(measured.out, measured.err);
  CHECK((measured.exit_code == 0 || measured.exit_code == 5)); // without matplotlib
  CHECK_THAT(TemporaryFolder::read(folder / "sampling.csv"), Contains("\nown.cl,0.4,0.4,10,60,"));
  CHECK_THAT(TemporaryFolder::read(folder / "sampling-no-roulette.csv"), Contains("\nown.cl,0.4,0.4,10,60,"));
}
