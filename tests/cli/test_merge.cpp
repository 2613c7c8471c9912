// The command phlux merge.
#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "cli/workplace.h"

using Catch::Contains;

TEST_CASE("Renders of the two halves of a seed's samples merge to the render of them all") {
  const Workplace place;
  const auto render = [&](const std::string& samples, const std::string& first, const std::string& image) {
    REQUIRE(run({{"render", "scene.xml", "-q", "--png", "none", "--moments", "-n", samples, "--first-sample",
                  first, "-o", image},
                 place.path(),
                 {},
                 {}})
                .exit_code == 0);
  };
  const auto merge = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "merge");
    return run({arguments, place.path(), {}, {}});
  };
  render("32", "0", "all.exr");
  render("16", "0", "a.exr");
  render("16", "16", "b.exr");
  const Outcome outcome = merge({"a.exr", "b.exr", "-o", "merged.exr"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "merged.exr: 16x12, 32 samples per pixel of 2 images\n");
  CHECK(outcome.err.empty());
  const auto all = place.image("all.exr"), merged = place.image("merged.exr");
  CHECK(merged.info.samples == 32.0);
  CHECK(merged.info.seed == 0);
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float>&expected = all.channels.at(name), &values = merged.channels.at(name);
    CHECK(std::ranges::equal(values, expected,
                             [](float x, float y) { return std::abs(x - y) <= 1e-6F * (x + y); }));
    CHECK(place.image("a.exr").channels.at(name) != expected);
  }
  double variance = 0.0, expected_variance = 0.0;
  for (std::size_t pixel = 0; pixel < 16 * 12; ++pixel) {
    variance += merged.channels.at("variance.G")[pixel];
    expected_variance += all.channels.at("variance.G")[pixel];
  }
  CHECK(variance == Approx(expected_variance).epsilon(0.1)); // that of each half is about its own mean

  const Outcome twice = merge({"a.exr", "b.exr", "all.exr", "-o", "none.exr"});
  CHECK(twice.exit_code == 3);
  CHECK(twice.is_one_line_error());
  CHECK_THAT(twice.err, Contains("all.exr: has samples 0 to 31 of seed 0, and b.exr has samples 16 to 31"));
  CHECK(merge({"a.exr", "-o", "none.exr"}).exit_code == 2);
  CHECK(merge({"a.exr", "b.exr"}).exit_code == 2);
  CHECK(merge({"a.exr", "scene.xml", "-o", "none.exr"}).exit_code == 3);
  CHECK(merge({"a.exr", "b.exr", "-o", "nowhere/none.exr"}).exit_code == 5);
  CHECK_FALSE(place.names().contains("none.exr"));
}

TEST_CASE("Values that are not finite are not written silently") {
  const Workplace place;
  phlux::files::Image image{.width = 1, .height = 1, .channels = {}, .info = {}};
  for (const char* name : {"R", "G", "B"}) image.channels[name] = {std::numeric_limits<float>::quiet_NaN()};
  image.info.samples = 4;
  for (const std::string file : {"a.exr", "b.exr"}) {
    image.info.ranges = {{file == "a.exr" ? 1U : 2U, 0, 4}};
    phlux::files::write_exr(place / file, image);
  }
  const Outcome outcome = run({{"merge", "a.exr", "b.exr", "-o", "m.exr"}, place.path(), {}, {}});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("phlux: warning: m.exr: 1 values of channel R are not finite"));
}
