// The shipped scenes by hits, by light samples and by both: three estimators of one image.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using render::Connect;

namespace {

struct Way {
  Connect connect;
  int samples;
};

// Images of 32x32 pixels, compared in tiles of `side` x `side` pixels.
Estimate image_of(const std::string& name, Way way, std::uint64_t seed, int side) {
  render::Settings with = settings_for(way.samples);
  with.connect = way.connect;
  with.seed = seed;
  const Render image = render_of(shipped(name, 32, 32), with);
  CHECK(image.statistics.nonfinite == 0);
  CHECK(std::ranges::all_of(image.film.pixels(), [](const film::Pixel& pixel) {
    return std::ranges::all_of(pixel.sum, [](double sum) { return std::isfinite(sum) && sum >= 0; });
  }));
  return tiles(estimate_of(image.film), side);
}

} // namespace

TEST_CASE("every shipped scene: hits alone, light samples alone and both agree; nothing is infinite") {
  REQUIRE(shipped_names().size() >= 8);
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    // One path in hundreds finds a caustic, one in a thousand the lamp over the leaves: only large tiles have
    // enough of them.
    if (name == "glass-caustic") continue; // one in millions
    const int side = name == "caustic" || name == "leaves" || name.starts_with("mirror") ? 16 : 4;
    const Estimate both = image_of(name, {Connect::mis, 128}, 1, side);
    // Light samples alone have infinite variance along the edges of a box with emitting walls.
    if (name != "furnace-box") {
      INFO("light samples alone against both");
      check_agreement(image_of(name, {Connect::light, 256}, 2, side), both);
    }
    // No path can hit a point light.
    if (name == "point-light") continue;
    INFO("hits alone against both");
    check_agreement(image_of(name, {Connect::none, 512}, 3, side), both);
  }
}

// Under a constant sky, wrong directions go undetected if the weights are constant; under a lamp that fills a
// part of the hemisphere they do not. At 80 degrees much of the lobe is below the horizon.
TEST_CASE("a lamp over a glossy plane at grazing angles: hits agree with light samples") {
  scene::Scene scene;
  scene.materials = {phong({0.05, 0.1, 0.05}, {0.9, 0.5, 0.3}, 8), diffuse({0, 0, 0})};
  scene.area_emitters = {{{1, 2, 3}}};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, {}),
                   square({0, 0.5, 1}, {0, 1, 0}, {1, 0, 0}, 0.8, {1, 0})};
  scene.camera = look_at({0, -3, 0.5}, {0, 0, 0}, 8, 4, 4);
  const auto image = [&](Connect connect, const std::string& strategy) {
    render::Settings with = settings_for(32768, 2);
    with.connect = connect;
    with.strategy = strategy;
    return estimate_of(render_of(scene, with).film);
  };
  const Estimate reference = image(Connect::light, render::Settings().strategy);
  for (const char* strategy : {"lobe-rho", "mixture", "fold", "exact"}) {
    CAPTURE(strategy);
    check_agreement(image(Connect::none, strategy), reference);
  }
}
