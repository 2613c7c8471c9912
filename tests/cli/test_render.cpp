#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/workplace.h"
#include "device/device.h"

using phlux::files::Image;

namespace {

struct Renders : Workplace {
  Outcome render(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"render", "scene.xml"});
    Outcome outcome = run({arguments, path(), {}, {}});
    CAPTURE(arguments, outcome.out, outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
  }
  [[nodiscard]] nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(read(*this / name));
  }
};

double mean(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

} // namespace

TEST_CASE("The plain command writes an image and a preview, named after the scene, and prints their names") {
  const Renders place;
  const Outcome outcome = place.render({});
  CHECK(place.names() == std::set<std::string>{"scene.xml", "scene.exr", "scene.png"});
  CHECK(std::ranges::count(outcome.out, '\n') == 1);
  CHECK_THAT(outcome.out, Catch::StartsWith("scene.exr: 16x12, 8 samples per pixel, ") &&
                              Catch::Contains("M paths/s") && Catch::Contains("relative standard error"));
  const Image image = place.image();
  CHECK(image.width == 16);
  CHECK(image.height == 12);
  CHECK(image.channels.size() == 3);
  for (const auto& [name, values] : image.channels) {
    CHECK(std::ranges::all_of(values, [](float value) { return std::isfinite(value) && value >= 0.0F; }));
    CHECK(mean(values) > 0.0);
  }
  CHECK(image.info.version == PHLUX_VERSION);
  CHECK(image.info.scene == "scene.xml");
  CHECK(image.info.text("integrator") == "path");
  CHECK(image.info.samples == 8.0);
  CHECK_FALSE(image.info.device.empty());
  CHECK_FALSE(image.info.driver.empty());
  CHECK(image.info.seconds > 0.0);
}

TEST_CASE("Options reach the files") {
  const Renders place;
  const Outcome outcome =
      place.render({"-q",         "-n",     "3",         "--size", "20x10",       "--seed",  "7",
                    "--moments",  "-o",     "out.exr",   "--png",  "look.png",    "--stats", "stats.json",
                    "--strategy", "cosine", "--connect", "light",  "--max-depth", "3"});
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
  CHECK(place.names() == std::set<std::string>{"scene.xml", "out.exr", "look.png", "stats.json"});
  const Image image = place.image("out.exr");
  CHECK(image.width == 20);
  CHECK(image.height == 10);
  CHECK(image.channels.size() == 7);
  CHECK(mean(image.channels.at("variance.G")) > 0.0);
  CHECK(image.info.samples == 3.0);
  CHECK(image.info.seed == 7);
  CHECK(image.info.text("strategy") == "cosine");
  CHECK_THAT(TemporaryFolder::read(place / "look.png"), Catch::StartsWith("\x89PNG"));
}

TEST_CASE("A crop is placed in the image of which it is a part, also when it resumes") {
  const Renders place;
  place.render({"-n", "3", "--crop", "4,5,7,3", "--checkpoint", "c", "--stats", "stats.json"});
  const Image crop = place.image();
  CHECK(crop.width == 7);
  CHECK(crop.height == 3);
  CHECK(crop.info.origin == std::array{4, 5});
  CHECK(crop.info.whole == std::array{16, 12});
  CHECK(place.json("stats.json")["crop"] == "4,5,7,3");
  place.render({"-n", "5", "--resume", "c"});
  CHECK(place.image().info.samples == 5);
  CHECK(place.image().info.text("crop") == "4,5,7,3");
  CHECK_THAT(run({{"render", "scene.xml", "--resume", "c", "--crop", "0,0,2,2"}, place.path(), {}, {}}).err,
             Catch::Contains("with --crop 4,5,7,3, not with --crop 0,0,2,2"));
}

TEST_CASE("--aov adds the channels that it names") {
  const Renders place;
  place.render({"-n", "2"});
  place.render({"-n", "2", "--aov", "depth,albedo", "-o", "more.exr"});
  const Image plain = place.image(), more = place.image("more.exr");
  CHECK(more.channels.size() == 11);
  for (const char* channel : {"R", "G", "B"}) CHECK(more.channels.at(channel) == plain.channels.at(channel));
  CHECK(mean(more.channels.at("albedo.G")) > 0.1);
  CHECK(mean(more.channels.at("depth.Z")) > 1.0);
  CHECK(mean(more.channels.at("variance.albedo.G")) > 0.0);
  CHECK(mean(more.channels.at("variance.depth.Z")) > 0.0);
}

TEST_CASE("Exposure and threads do not change the image") {
  const Renders place;
  place.render({"-n", "2"});
  place.render({"-n", "2", "--exposure", "-20", "--threads", "1", "-o", "dark.exr"});
  CHECK(place.image("dark.exr").channels == place.image().channels);
  CHECK(std::filesystem::file_size(place / "dark.png") < std::filesystem::file_size(place / "scene.png"));
  CHECK_THAT(run({{"render", "scene.xml", "--threads", "60000"}, place.path(), {}, {}}).err,
             Catch::Contains("--threads 60000: OpenCL device"));
}

TEST_CASE("Several scenes are rendered one after the other") {
  const Renders place;
  place.write("other.xml", good_scene);
  const Outcome outcome = place.render({"other.xml", "-n", "1"});
  CHECK(std::ranges::count(outcome.out, '\n') == 2);
  CHECK(place.image().channels == place.image("other.exr").channels);
  const Outcome missing = run({{"render", "scene.xml", "none.xml", "-q"}, place.path(), {}, {}});
  CHECK(missing.exit_code == 3);
  CHECK_THAT(missing.err, Catch::Contains("none.xml: cannot be read"));
  CHECK_FALSE(missing.err.find("scene.xml: ") < missing.err.size());
}

TEST_CASE("integrator auto chooses what --contributions needs") {
  const Renders place;
  const Outcome outcome = place.render({"-i", "auto", "--contributions", "techniques"});
  CHECK(place.image().info.text("integrator") != "path");
  CHECK(std::filesystem::exists(place / "techniques/contributions.png"));
}

TEST_CASE("A render by integrator auto resumes by what it chose, and still says why") {
  const Renders place;
  place.render({"-i", "auto", "-n", "64", "--checkpoint", "c", "--stats", "begun.json"});
  const nlohmann::json begun = place.json("begun.json");
  CHECK(begun["choice"].is_string());
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"-i", "auto"}}) {
    std::vector<std::string> arguments = {"--resume", "c", "-n", "128", "--stats", "on.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    place.render(arguments);
    const nlohmann::json on = place.json("on.json");
    CHECK(on["samples_per_pixel"] == 128.0);
    for (const char* key : {"choice", "integrator", "connect", "weights", "sampler"})
      CHECK(on[key] == begun[key]);
  }
}

TEST_CASE("Statistics have the contract's keys with values of the right kind") {
  const Renders place;
  place.render({"-n", "4", "--stats", "stats.json"});
  const nlohmann::json stats = place.json("stats.json");
  for (const char* key : {"integrator", "strategy", "device", "driver", "kernel_cache", "traversal"}) {
    CAPTURE(key);
    CHECK((stats.at(key).is_string() && !stats.at(key).get<std::string>().empty()));
  }
  for (const char* key : {"width", "height", "samples_per_pixel", "paths", "rays", "shadow_rays", "nonfinite",
                          "lanes", "variance", "relative_standard_error"})
    CHECK(stats.at(key).is_number());
  for (const char* key : {"setup", "build_kernels", "render"}) CHECK(stats.at("seconds").at(key).is_number());
  CHECK(stats["parts"].is_array());
  CHECK(stats["paths"] == 16 * 12 * 4);
  CHECK(stats["rays"] >= stats["paths"]);
  CHECK(stats["samples_per_pixel"] == 4.0);
  CHECK(stats["nonfinite"] == 0);
  CHECK(stats["variance"] > 0.0);
  const std::string cache = stats["kernel_cache"];
  CHECK((cache == "hit" || cache == "miss"));

  place.render({"-n", "4", "--stats", "again.json"});
  CHECK(place.json("again.json")["kernel_cache"] == "hit");
}

TEST_CASE("The scene selects the integrator, unless -i is given") {
  const Renders place;
  const auto integrator_of = [&](const std::string& plugin, std::vector<std::string> options) {
    std::string scene = good_scene;
    scene.replace(scene.find("\"path\""), 6, '"' + plugin + '"');
    place.write("scene.xml", scene);
    options.insert(options.end(), {"--stats", "stats.json"});
    place.render(options);
    return place.json("stats.json")["integrator"];
  };
  CHECK(integrator_of("ptracer", {}) == "light");
  CHECK(integrator_of("bdpt", {}) == "bidir");
  CHECK(integrator_of("bdpt", {"-i", "path"}) == "path");
  CHECK(integrator_of("path", {"-i", "light"}) == "light");
}

TEST_CASE("Every width and traversal renders, and --stats says which") {
  const Renders place;
  for (const char* width : {"1", "4", "8", "16"})
    for (const char* traversal : {"brute", "bvh"}) {
      CAPTURE(width, traversal);
      place.render({"-n", "64", "--width", width, "--traversal", traversal, "--stats", "stats.json"});
      const nlohmann::json stats = place.json("stats.json");
      CHECK(stats["lanes"] == std::stoi(width));
      CHECK(stats["traversal"] == traversal);
      CHECK(mean(place.image().channels.at("G")) == Approx(0.0).margin(10.0)); // and is finite
    }
}

// The macro makes an existing builtin unusable.
TEST_CASE("Where the compiler refuses the processor's own instructions, portable lanes make the same image") {
  const phlux::device::DeviceInfo device = phlux::device::open_devices({}).front().info;
  if (device.platform != "Portable Computing Language" || device.native_float_width != 16)
    return; // no AVX-512
  const Renders place;
  place.render({"-o", "a.exr", "--width", "16", "--stats", "a.json"});
  CHECK(place.json("a.json")["portable_lanes"] == false);
  const Outcome portable =
      run({{"render", "scene.xml", "-o", "b.exr", "--width", "16", "--stats", "b.json", "--verbose"},
           place.path(),
           {{"PHLUX_KERNEL_OPTIONS", "-D__builtin_ia32_gathersiv16sf(a,b,c,d,e)=nowhere"}},
           {}});
  REQUIRE(portable.exit_code == 0);
  CHECK_THAT(portable.err, Catch::Contains("portable lanes on ") && Catch::Contains("'nowhere'"));
  CHECK(place.json("b.json")["portable_lanes"] == true);
  CHECK(place.image("a.exr").channels == place.image("b.exr").channels);
}

TEST_CASE("--precision double renders the same image but for rounding, and --stats says so") {
  if (!phlux::device::open_devices({}).front().info.doubles) return;
  const Renders place;
  place.render({"-o", "a.exr", "--width", "1"});
  place.render({"-o", "b.exr", "--precision", "double", "--stats", "stats.json"});
  const nlohmann::json stats = place.json("stats.json");
  CHECK(stats["lanes"] == 1);
  CHECK_THAT(stats["parts"].dump(), Catch::Contains("\"double_precision\""));
  const double a = mean(place.image("a.exr").channels.at("G")),
               b = mean(place.image("b.exr").channels.at("G"));
  CHECK(b == Approx(a).epsilon(1e-4));
  CHECK(place.image("a.exr").channels != place.image("b.exr").channels);
}

TEST_CASE("The same seed gives the same image, another seed another") {
  const Renders place;
  place.render({"--seed", "1", "-o", "a.exr"});
  place.render({"--seed", "1", "-o", "b.exr"});
  place.render({"--seed", "2", "-o", "c.exr"});
  CHECK(place.image("a.exr").channels == place.image("b.exr").channels);
  CHECK(place.image("a.exr").channels != place.image("c.exr").channels);
}

TEST_CASE("-D reaches the scene") {
  const Renders place;
  place.render({"-o", "a.exr"});
  place.render({"-D", "radiance=40", "-o", "b.exr"});
  CHECK(mean(place.image("b.exr").channels.at("R")) ==
        Approx(2.0 * mean(place.image("a.exr").channels.at("R"))).epsilon(1e-4));
}

TEST_CASE("--time and --error determine the number of samples") {
  const Renders place;
  place.render({"--time", "0.5", "--stats", "stats.json"});
  const nlohmann::json timed = place.json("stats.json");
  CHECK(timed["seconds"]["render"] >= 0.45);
  CHECK(timed["seconds"]["render"] < 60.0); // generous, for a busy machine
  CHECK(timed["samples_per_pixel"] > 0.0);

  place.render({"--error", "0.05", "--stats", "stats.json"});
  CHECK(place.json("stats.json")["relative_standard_error"] <= 0.05);
}

TEST_CASE("An interrupted render writes the image so far and exits with 130") {
  const Renders place;
  place.render({"--time", "0.1"}); // fills the kernel cache
  std::filesystem::remove(place / "scene.exr");
  const Outcome outcome = run({{"render", "scene.xml", "--time", "300", "--stats", "stats.json"},
                               place.path(),
                               {},
                               std::chrono::milliseconds(500)});
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.exit_code == 130);
  CHECK_THAT(outcome.out, Catch::EndsWith(", interrupted\n"));
  CHECK(place.names() == std::set<std::string>{"scene.xml", "scene.exr", "scene.png", "stats.json"});
  CHECK(place.image().info.samples > 0.0);
  CHECK(place.json("stats.json")["interrupted"] == true);
}

// The trials of --advise take seconds.
TEST_CASE("A signal after the image ends what is left to do, and only that") {
  const Renders place;
  Invocation invocation{{"render", "scene.xml", "-n", "16", "--advise", "--stats", "stats.json"},
                        place.path(),
                        {},
                        std::chrono::milliseconds(0)};
  invocation.signal = SIGTERM;
  invocation.after_write = place / "scene.png";
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run(invocation);
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.exit_code == 130);
  CHECK_THAT(
      outcome.err,
      Catch::EndsWith("phlux: warning: interrupted before these were done: trials of other integrators\n"));
  CHECK(place.image().info.samples == 16.0);
  CHECK_THAT(outcome.out, Catch::Contains("relative standard error") && !Catch::Contains("advice"));
  const nlohmann::json stats = place.json("stats.json");
  CHECK(stats["interrupted"] == false); // all samples were taken
  CHECK(stats["reliability"]["coverage"] > 0.0);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::minutes(1)); // generous, for a busy machine
}

TEST_CASE("One sample has no variance: it is left out, not 0") {
  const Renders place;
  const Outcome outcome = place.render({"-n", "1", "--moments", "--stats", "stats.json"});
  CHECK_THAT(outcome.err, Catch::Contains("--moments: variances need two samples in every pixel"));
  CHECK(place.image().channels.size() == 3);
  const nlohmann::json stats = place.json("stats.json");
  CHECK(stats.at("variance").is_null());
  CHECK(stats.at("relative_standard_error").is_null());
}

TEST_CASE("Lights beyond what float can square render; variances that a file cannot hold are named") {
  const Renders place;
  place.render({"--stats", "plain.json"});
  const Outcome outcome = place.render({"-D", "radiance=2e25", "--moments", "--stats", "bright.json"});
  CHECK_THAT(outcome.err,
             Catch::Contains("values of channel variance.B are not finite, being beyond a float's 3e38"));
  CHECK(place.json("bright.json")["relative_standard_error"].get<double>() ==
        Approx(place.json("plain.json")["relative_standard_error"].get<double>()).epsilon(1e-4));
  CHECK(mean(place.image().channels.at("G")) > 1e22);
}

TEST_CASE("An unreliable error is one line: what it may be, and what helps; --quiet leaves it to --stats") {
  const Renders place;
  const std::vector<std::string> rare = {"--connect", "none", "-n", "16", "--stats", "stats.json"};
  const std::string err = place.render(rare).err;
  const std::size_t start = err.find("phlux: warning: "); // after a note that kernels are built
  REQUIRE(start != std::string::npos);
  CHECK(std::ranges::count(err.substr(start), '\n') == 1);
  CHECK_THAT(err.substr(start), Catch::StartsWith("phlux: warning: the relative standard error of ") &&
                                    Catch::Contains("% may be ") &&
                                    Catch::Contains("95% intervals contain the true value in ") &&
                                    Catch::Contains("--advise") && Catch::Contains("--clamp"));
  const nlohmann::json unreliable = place.json("stats.json");
  CHECK(unreliable["reliability"]["trusted"] == false);
  CHECK(unreliable["reliability"]["coverage"] < 0.5);
  CHECK(unreliable["reliability"]["relative_standard_error"] > unreliable["relative_standard_error"]);
  std::vector<std::string> quiet = rare;
  quiet.emplace_back("-q");
  CHECK(place.render(quiet).err.empty());
  CHECK(place.json("stats.json")["reliability"] == unreliable["reliability"]);
  CHECK_THAT(place.render({"-n", "64", "--stats", "stats.json"}).err, !Catch::Contains("warning"));
  CHECK(place.json("stats.json")["reliability"]["trusted"] == true);
}

TEST_CASE("--png none leaves the preview out") {
  const Renders place;
  place.render({"--png", "none"});
  CHECK(place.names() == std::set<std::string>{"scene.xml", "scene.exr"});
}

TEST_CASE("--size keeps the field of view along fovAxis") {
  const Renders place;
  std::string text = TemporaryFolder::read(place / "scene.xml");
  text.insert(text.find("<float name=\"fov\""), "<string name=\"fovAxis\" value=\"y\"/>");
  place.write("scene.xml", text);
  place.render({"-n", "256", "--size", "8x12", "-o", "narrow.exr"});
  place.render({"-n", "256", "--size", "24x12", "-o", "wide.exr"});
  const Image narrow = place.image("narrow.exr"), wide = place.image("wide.exr");
  double of_narrow = 0, of_wide = 0; // the narrow image is the middle third of the wide one
  for (std::size_t y = 0; y < 12; ++y)
    for (std::size_t x = 0; x < 8; ++x) {
      of_narrow += narrow.channels.at("G")[8 * y + x];
      of_wide += wide.channels.at("G")[24 * y + x + 8];
    }
  CHECK(of_narrow == Approx(of_wide).epsilon(0.05));
}

TEST_CASE("An output that is not a regular file is written, without a preview") {
  const Renders place;
  place.render({"-o", "/dev/null"});
  CHECK(std::filesystem::is_character_file("/dev/null"));
  CHECK(place.names() == std::set<std::string>{"scene.xml"});
}
