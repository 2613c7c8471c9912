// Interrupting and resuming renders with the program.
#include <catch2/catch.hpp>

#include "cli/workplace.h"

using Catch::Contains;
using phlux::files::Image;

namespace {

struct Renders : Workplace {
  Outcome render(std::vector<std::string> arguments,
                 std::optional<std::chrono::milliseconds> interrupt_after = {}) const {
    arguments.insert(arguments.begin(), {"render", "scene.xml", "--png", "none"});
    return run({arguments, path(), {}, interrupt_after});
  }
};

} // namespace

TEST_CASE("An interrupted render resumes from its checkpoint to the image of an uninterrupted one") {
  const Renders place;
  REQUIRE(place.render({"-n", "20", "--seed", "3", "-D", "radiance=10", "-o", "short.exr"}).exit_code == 0);
  const Outcome broken =
      place.render({"--time", "300", "--seed", "3", "-D", "radiance=10", "--checkpoint", "c"},
                   std::chrono::milliseconds(200));
  CHECK(broken.exit_code == 130);
  CHECK_THAT(broken.out, Contains(", interrupted: --resume c goes on\n"));
  const double samples = place.image("scene.exr").info.samples;

  // Options that are not given keep their values, and the file holds the latest checkpoint.
  const std::string more = std::to_string(static_cast<int>(samples) / 16 * 16 + 64);
  const Outcome resumed = place.render({"--resume", "c", "-n", more, "--moments", "-o", "resumed.exr"});
  CAPTURE(resumed.out, resumed.err);
  REQUIRE(resumed.exit_code == 0);
  const Image image = place.image("resumed.exr");
  CHECK(image.info.samples == std::stod(more));
  CHECK(image.info.seed == 3);
  CHECK(image.info.ranges == std::vector<phlux::files::SampleRange>{{3, 0, std::stoi(more)}});
  CHECK(image.info.seconds > place.image("scene.exr").info.seconds);
  CHECK(place.render({"--resume", "c", "-n", "8"}).exit_code == 2);
  CHECK_THAT(place.render({"--resume", "c", "-n", "8"}).err,
             Contains("has " + more + " samples per pixel already"));

  // Whole blocks of samples; the render is complete.
  REQUIRE(place.render({"--resume", "c", "-o", "again.exr", "--moments"}).exit_code == 0);
  CHECK(place.image("again.exr").channels == image.channels);
  CHECK(place.names() ==
        std::set<std::string>{"scene.xml", "short.exr", "scene.exr", "resumed.exr", "again.exr", "c"});
}

TEST_CASE("Checkpoints are written during the render, which resumes from any of them") {
  const Renders place;
  REQUIRE(place.render({"-n", "64", "--moments", "-o", "whole.exr"}).exit_code == 0);
  REQUIRE(place.render({"-n", "64", "--checkpoint", "first", "--checkpoint-every", "0.01"}).exit_code == 0);
  REQUIRE(place.render({"-n", "16", "--checkpoint", "second"}).exit_code == 0);
  for (const std::string name : {"first", "second"}) {
    const std::string before = TemporaryFolder::read(place / name);
    REQUIRE(place.render({"--resume", name, "--checkpoint", "none", "-n", "64", "--moments", "-o", "on.exr"})
                .exit_code == 0);
    CHECK(place.image("on.exr").channels == place.image("whole.exr").channels);
    CHECK(TemporaryFolder::read(place / name) == before);
  }
  CHECK_THAT(place.render({"-n", "1", "--checkpoint", "second"}).err,
             Contains("--checkpoint second: replaces an earlier checkpoint"));
}

TEST_CASE("A file that is not a checkpoint of this render is refused in one line, and nothing is written") {
  const Renders place;
  REQUIRE(place.render({"-n", "2", "--checkpoint", "c", "-o", "a.exr"}).exit_code == 0);
  place.write("other.xml", scene_with(sphere_of("")));
  place.write("foreign", "no checkpoint");
  const auto refusal = [&](std::vector<std::string> options, int exit_code) {
    options.insert(options.end(), {"-o", "b.exr"});
    const Outcome outcome = place.render(options);
    CAPTURE(options, outcome.err);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.is_one_line_error());
    return outcome.err;
  };
  CHECK_THAT(refusal({"--resume", "c", "-i", "light"}, 3),
             Contains("c: is of a render with --integrator path"));
  CHECK_THAT(refusal({"--resume", "c", "--size", "8x8"}, 3), Contains("c: is of 16x12 pixels, not 8x8"));
  CHECK_THAT(refusal({"--resume", "c", "-D", "radiance=5"}, 3),
             Contains("c: is of another scene: give scene.xml as it was"));
  CHECK_THAT(refusal({"--resume", "c", "-n", "1"}, 2), Contains("c: has 2 samples per pixel already"));
  CHECK_THAT(refusal({"--resume", "foreign"}, 3), Contains("foreign: is not a checkpoint of phlux"));
  CHECK_THAT(refusal({"--checkpoint-every", "5"}, 2),
             Contains("--checkpoint-every: no checkpoint is written"));
  CHECK_THAT(refusal({"--checkpoint", "b.exr"}, 2), Contains("b.exr: named for two outputs"));
  CHECK_THAT(refusal({"--checkpoint", "nowhere/c"}, 5), Contains("nowhere/c: cannot be written"));
  const Outcome other = run({{"render", "other.xml", "--resume", "c"}, place.path(), {}, {}});
  CHECK(other.exit_code == 3);
  CHECK_THAT(other.err, Contains("c: is of another scene"));
  CHECK(place.names() == std::set<std::string>{"scene.xml", "other.xml", "foreign", "a.exr", "c"});
}

TEST_CASE("If a checkpoint cannot be written, the earlier one stays and the image is written") {
  const Renders place;
  REQUIRE(place.render({"-n", "2", "--size", "256x256", "--checkpoint", "c"}).exit_code == 0);
  const std::string before = TemporaryFolder::read(place / "c");
  std::filesystem::remove(place / "scene.exr");
  // Larger than the driver's cached kernels, smaller than the checkpoint.
  constexpr std::size_t largest_file = std::size_t{1} << 21;
  CHECK(before.size() > largest_file);
  const Outcome outcome = run({{"render", "scene.xml", "--resume", "c", "-n", "4", "--png", "none"},
                               place.path(),
                               {},
                               {},
                               largest_file});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.err, Contains("c: cannot be written: File too large: make room"));
  CHECK(place.image("scene.exr").info.samples == 4.0);
  CHECK(TemporaryFolder::read(place / "c") == before);
}
