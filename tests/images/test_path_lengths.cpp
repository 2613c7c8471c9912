// Termination of paths.
#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;

TEST_CASE("roulette changes no expectation, whenever it begins") {
  const scene::Scene scene = shipped("cornell-box", 16, 16);
  const auto image = [&](int rr_depth) {
    render::Settings with = settings_for(512);
    with.rr_depth = rr_depth;
    with.seed = static_cast<std::uint64_t>(rr_depth + 10);
    return tiles(estimate_of(render_of(scene, with).film), 2);
  };
  const Estimate never = image(-1);
  for (const int rr_depth : {1, 2, 5}) {
    CAPTURE(rr_depth);
    check_agreement(image(rr_depth), never);
  }
}

TEST_CASE("a path has as many edges as it may, and no more") {
  const scene::Scene scene = shipped("furnace-box", 16, 16);
  for (const int depth : {1, 2, 7}) {
    CAPTURE(depth);
    render::Settings with = settings_for(16, depth);
    with.rr_depth = -1; // without roulette no path of a closed box ends earlier
    const Render image = render_of(scene, with);
    CHECK(image.statistics.paths == 4096);
    CHECK(image.statistics.rays == 4096u * static_cast<unsigned>(depth));
    CHECK(image.statistics.shadow_rays <= 4096u * static_cast<unsigned>(depth - 1));
  }
}

TEST_CASE("a closed room that absorbs nothing ends all the same") {
  scene::Scene scene = shipped("furnace-box", 4, 4);
  for (scene::Material& material : scene.materials) material = diffuse({1, 1, 1});
  const Render image = render_of(scene, settings_for(16));
  CHECK(image.statistics.paths == 256);
  CHECK(image.statistics.nonfinite == 0);
  // The probability of survival is at most 0.999: 1000 edges per path on average, for 256 paths.
  CHECK(image.statistics.rays > 100'000);
  CHECK(image.statistics.rays < 1'000'000);
}
