#include <sstream>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "cli/scenes.h"

namespace {

struct Wrong {
  std::vector<std::string> arguments;
  std::string message; ///< part of it
};

const std::vector<Wrong> wrong_usage = {
    {{}, "no command"},
    {{"rendr", "scene.xml"}, "did you mean render?"},
    {{"paint"}, "must be one of render, info, devices, compare, merge, view, bench"},
    {{"render"}, "SCENE.xml"},
    {{"render", "scene.xml", "other.xml", "-o", "a.exr"},
     "--output a.exr: can be used with one scene only: 2 are given"},
    {{"render", "scene.xml", "a/scene.xml"}, "a/scene.xml: another scene is called scene too"},
    {{"render", "scene.xml", "--crop", "0,0,4"}, "--crop 0,0,4: must be X,Y,WIDTH,HEIGHT"},
    {{"render", "scene.xml", "--crop", "0,0,4,0"}, "--crop 0,0,4,0: must be X,Y,WIDTH,HEIGHT"},
    {{"render", "scene.xml", "--crop", "10,0,7,4"}, "--crop 10,0,7,4: is not within the image of 16x12"},
    {{"render", "scene.xml", "--aov", "albedo,uv"}, "--aov uv: must be one of albedo, normal, depth"},
    {{"render", "scene.xml", "--threads", "0"}, "--threads 0: must be a whole number from 1"},
    {{"render", "scene.xml", "--exposure", "bright"}, "--exposure bright: must be a number"},
    {{"view", "a.exr", "--exposure", "1"}, "--exposure 1: is for --png"},
    {{"completion", "fish"}, "unknown command fish"},
    {{"render", "scene.xml", "--ssp", "4"}, "unknown option --ssp: did you mean --spp?"},
    {{"render", "scene.xml", "--denoise", "a"}, "unknown option --denoise"},
    {{"render", "scene.xml", "--checkpoint-every", "0"}, "--checkpoint-every 0: must be a number from 0.01"},
    {{"render", "scene.xml", "--first-sample", "-1"}, "--first-sample -1: must be a whole number from 0"},
    {{"merge", "a.exr", "-o", "b.exr"}, "merge a.exr: one image: at least two are needed"},
    {{"merge", "a.exr", "b.exr"}, "--output is required"},
    {{"render", "scene.xml", "-n"}, "--spp: a value is missing"},
    {{"render", "scene.xml", "-n", "0"}, "--spp 0: must be a whole number from 1"},
    {{"render", "scene.xml", "-n", "1.5"}, "--spp 1.5: must be a whole number"},
    {{"render", "scene.xml", "-n", "4000000000"}, "--spp 4000000000: must be"},
    {{"render", "scene.xml", "-n", "4", "--time", "1"}, "excludes --time"},
    {{"render", "scene.xml", "--time", "-1"}, "--time -1: must be a number from 1e-06 to 1000000000"},
    {{"render", "scene.xml", "--time", "nan"}, "--time nan: must be a number from 1e-06 to 1000000000"},
    {{"render", "scene.xml", "--time", "inf"}, "--time inf: must be a number from 1e-06 to 1000000000"},
    {{"render", "scene.xml", "--error", "0"}, "--error 0: must be a number from 1e-30 to 1e+30"},
    {{"render", "scene.xml", "--clamp", "1e39"}, "--clamp 1e39: must be a number from 1e-30 to 1e+30"},
    {{"render", "scene.xml", "--clamp", "1e-320"}, "--clamp 1e-320: must be a number from 1e-30"},
    {{"render", "scene.xml", "--ambient", "1e308"}, "--ambient 1e308: must be a number from 1e-30"},
    {{"render", "scene.xml", "--size", "0x4"}, "--size 0x4: must be WIDTHxHEIGHT"},
    {{"render", "scene.xml", "--size", "640"}, "--size 640: must be WIDTHxHEIGHT"},
    {{"render", "scene.xml", "--size", "99999x99999"}, "at most 2^28 pixels"},
    {{"render", "scene.xml", "--seed", "-1"}, "--seed -1: must be a whole number from 0"},
    {{"render", "scene.xml", "-D", "radiance"}, "-D radiance: must be NAME=VALUE"},
    {{"render", "scene.xml", "-D", "radiance=1", "-D", "radiance=2"},
     "-D radiance=2: and -D radiance=1 is given too: give one of the two"},
    {{"render", "scene.xml", "--seed", "1", "--seed", "2"}, "--seed 2: and --seed 1 is given too"},
    {{"render", "scene.xml", "-n", "1", "-n", "1", "--spp", "2"}, "--spp 2: and --spp 1 is given too"},
    {{"render", "scene.xml", "-o", "a.exr", "-o", "b.exr"},
     "--output b.exr: and --output a.exr is given too"},
    {{"render", "scene.xml", "--size", "268435456x1"},
     "--size 268435456x1: must be WIDTHxHEIGHT in pixels, such as 640x480: at most 32768 pixels along each "
     "side"},
    {{"render", "scene.xml", "-i", "pth"}, "--integrator pth: did you mean path?"},
    {{"render", "scene.xml", "--strategy", "mixtur"}, "--strategy mixtur: did you mean mixture?"},
    {{"render", "scene.xml", "--strategy", "magic"}, "--strategy magic: must be one of"},
    {{"render", "scene.xml", "--connect", "all"}, "--connect all: must be one of none, light, mis"},
    {{"render", "scene.xml", "-i", "light", "--connect", "mis"}, "--connect is for path only: light finds"},
    {{"render", "scene.xml", "-i", "bidir", "--connect", "none"}, "--connect is for path only: bidir finds"},
    {{"render", "scene.xml", "-i", "bidir", "--weights", "powr"}, "--weights powr: did you mean power?"},
    {{"render", "scene.xml", "--weights", "power"}, "--weights is for bidir only"},
    {{"render", "scene.xml", "-i", "light", "--weights", "balance"}, "--weights is for bidir only"},
    {{"render", "scene.xml", "--light-selection", "contributions"}, "did you mean contribution?"},
    {{"render", "scene.xml", "-i", "light", "--light-selection", "power"},
     "--light-selection is for light samples"},
    {{"render", "scene.xml", "-i", "bidir", "--connections", "-1"}, "--connections -1: must be"},
    {{"render", "scene.xml", "--connections", "4"}, "--connections is for bidir only"},
    {{"render", "scene.xml", "--max-depth", "0"},
     "--max-depth 0: must be a whole number of 1 or more, or -1"},
    {{"render", "scene.xml", "--rr-depth", "-2"}, "--rr-depth -2: must be"},
    {{"render", "scene.xml", "--width", "3"}, "--width 3: must be one of 1, 4, 8, 16"},
    {{"render", "scene.xml", "--precision", "half"}, "--precision half: must be one of single, double"},
    {{"render", "scene.xml", "--precision", "double", "--width", "4"}, "leave --width out"},
    {{"render", "scene.xml", "--traversal", "octree"}, "--traversal octree: must be one of auto, brute, bvh"},
    {{"render", "scene.xml", "--kernel-dir", "missing"}, "--kernel-dir missing: must be a folder"},
    {{"render", "scene.xml", "-o", "image.png"}, "such as image.exr"},
    {{"render", "scene.xml", "-o", "a.exr", "--stats", "./a.exr"}, "named for two outputs"},
    {{"render", "scene.xml", "--png", "a.jpg"},
     "--png a.jpg: the preview is a PNG file, such as a.png; none"},
    {{"render", "scene.xml", "--png", "a.exr"}, "--png a.exr: the preview is a PNG file"},
    {{"render", "scene.xml", "--png", "none", "--exposure", "1"}, "--exposure: is for the preview"},
    {{"render", "scene.xml", "--checkpoint", "none", "--checkpoint-every", "1"}, "no checkpoint is written"},
    {{"render", "scene.xml", "-q", "--advise"}, "--advise: --quiet silences it"},
    {{"render", "scene.xml", "--clamp", "1", "--ambient", "1"}, "leave out --ambient or --clamp"},
    {{"merge", "a.exr", "b.exr", "-o", "m.png"},
     "--output m.png: the image is an OpenEXR file, such as m.exr"},
    {{"compare", "a.exr"}, "B.exr"},
    {{"compare", "a.exr", "b.exr", "--fail-above", "psnr=30"}, "where METRIC is one of mean_error, rmse, "},
    {{"compare", "a.exr", "b.exr", "--fail-above", "rmse"}, "--fail-above rmse: must be METRIC=VALUE"},
    {{"compare", "a.exr", "b.exr", "--fail-above", "rmse=1%"}, "and VALUE a number of 0 or more"},
    {{"compare", "a.exr", "b.exr", "--fail-above", "rmse=nan"}, "and VALUE a number of 0 or more"},
    {{"compare", "a.exr", "b.exr", "--png", ""}, "--png '': must be a file name"},
    {{"devices", "now"}, "now: one argument too many"},
};

} // namespace

TEST_CASE("Wrong usage is one line and exit code 2, and writes nothing") {
  const TemporaryFolder folder;
  folder.write("scene.xml", good_scene);
  for (const auto& [arguments, message] : wrong_usage) {
    const Outcome outcome = run({arguments, folder.path(), {}, {}});
    CAPTURE(arguments, outcome.out, outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.is_one_line_error());
    CHECK_THAT(outcome.err, Catch::Contains(message));
    CHECK(outcome.out.empty());
  }
  CHECK(folder.names() == std::set<std::string>{"scene.xml"});
}

TEST_CASE("Help and version are no errors") {
  const TemporaryFolder folder;
  const Outcome help = run({{"--help"}, folder.path(), {}, {}});
  CHECK(help.exit_code == 0);
  for (const char* word : {"render", "devices", "compare", "Exit codes"})
    CHECK_THAT(help.out, Catch::Contains(word));
  const Outcome of_render = run({{"render", "--help"}, folder.path(), {}, {}});
  CHECK(of_render.exit_code == 0);
  for (const char* option : {"--output",    "--integrator", "--strategy", "--connect", "--spp",   "--time",
                             "--error",     "--max-depth",  "--rr-depth", "--size",    "--seed",  "-D",
                             "--device",    "--moments",    "--png",      "--stats",   "--quiet", "--width",
                             "--traversal", "--kernel-dir", "--precision"})
    CHECK_THAT(of_render.out, Catch::Contains(option));
}

TEST_CASE("The options of every command fit a terminal of 100 columns") {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> commands = {
      {"render"},        {"info"},      {"devices"},         {"compare"},           {"merge"},
      {"view"},          {"verify"},    {"bench", "scenes"}, {"bench", "sampling"}, {"bench", "stability"},
      {"bench", "rays"}, {"completion"}};
  for (std::vector<std::string> arguments : commands) {
    arguments.emplace_back("--help");
    std::istringstream lines(run({arguments, folder.path(), {}, {}}).out);
    for (std::string line; std::getline(lines, line);)
      if (line.size() > 100 && line.starts_with("  -")) FAIL_CHECK(line);
  }
}

// CLI11 2.4 throws for other names, whatever the command.
TEST_CASE("The placeholder of an argument is one word") {
  const TemporaryFolder folder;
  for (const char* command : {"render", "info", "compare", "merge", "view"}) {
    const Outcome help = run({{command, "--help"}, folder.path(), {}, {}});
    const std::size_t list = help.out.find("Positionals:\n");
    REQUIRE(list != std::string::npos);
    std::istringstream lines(help.out.substr(list));
    std::string line;
    std::getline(lines, line);
    for (; std::getline(lines, line) && !line.empty();) {
      CAPTURE(command, line);
      CHECK_THAT(line, Catch::Matches("  [^ ]+( [.][.][.])?(  .*)?"));
    }
  }
}

TEST_CASE("The version has everything that a bug report needs") {
  const TemporaryFolder folder;
  const Outcome version = run({{"--version"}, folder.path(), {}, {}});
  CHECK(version.exit_code == 0);
  CHECK(version.err.empty());
  CHECK_THAT(version.out, Catch::StartsWith("phlux " PHLUX_VERSION "\n"));
  for (const char* text : {"\ncommit     ", "\ncompiler   ", "\nlibraries  OpenEXR ", "Embree ", "fmt ",
                           "spdlog ", "pugixml ", "CLI11 ", "\nOpenCL     ", "\nplatform 0 "})
    CHECK_THAT(version.out, Catch::Contains(text));
  CHECK_THAT(version.out, !Catch::Contains("unknown version"));
  // cli/commit.sh tests the commit: this build may be older than HEAD, or made without git.
  CHECK_THAT(version.out, Catch::Matches("(.|\\n)*\\ncommit     ([0-9a-f]{7,} of 20|unknown\\n)(.|\\n)*"));
}

TEST_CASE("Without a platform the version says so") {
  const TemporaryFolder folder;
  const Outcome version = run({{"--version"}, folder.path(), {{"OCL_ICD_VENDORS", folder.path()}}, {}});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, Catch::EndsWith("\nplatform   none\n"));
}

// Run by ctest, which searches the output of this failure for the program's standard error.
TEST_CASE("A run whose failure is shown", "[.fails]") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"paint"}, folder.path(), {}, {}});
  CHECK(outcome.out.empty());
  CHECK(outcome.exit_code == 0);
}
