// Techniques that reduce variance do not change the mean.
#include <catch2/catch.hpp>

#include "film/reliability.h"
#include "images/evidence.h"
#include "images/integrators.h"
#include "images/room.h"

using namespace phlux;
using namespace phlux::test;
using render::LightSelection;
using scene::Rgb;
using scene::Vec3;

namespace {

render::Settings with(const Method& method, int samples, std::uint64_t seed) {
  render::Settings result = by(method, settings_for(samples));
  result.seed = seed;
  return result;
}

// A floor under a row of lamps, of which different ones are near each place.
scene::Scene floor_under_lamps(int lamps) {
  scene::Scene scene;
  const double half = lamps / 2.0;
  scene.materials = {phong(Rgb(0.5), Rgb(0.3), 20), diffuse(Rgb(0.0))};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, half, {0, -1})};
  for (int i = 0; i < lamps; ++i) {
    scene.area_emitters.push_back({Rgb(1 + i % 3, 2, 3)});
    scene.patches.push_back(square({i + 0.5 - half, 0, 0.5}, {0, 1, 0}, {1, 0, 0}, 0.1, {1, i}));
  }
  scene.camera = look_at({0, -3, 1}, {0, 0, 0}, 60, 16, 16);
  return scene;
}

double variance(const Render& render) {
  return film::reliability_of(render.film).variance;
}

} // namespace

TEST_CASE("light samples by power and by contribution agree, from all kinds of lights") {
  const scene::Scene scene = room(emitter_kinds());
  render::Settings by_power = with(path, 256, 1);
  by_power.light_selection = LightSelection::power;
  const Estimate reference = tiles(estimate_of(render_of(scene, by_power).film), 4);
  for (const Method& method : {path_light_samples, path, bidir}) {
    CAPTURE(name_of(method));
    const Render image = render_of(scene, with(method, 256, 2));
    CHECK(image.statistics.nonfinite == 0);
    check_agreement(tiles(estimate_of(image.film), 4), reference);
  }
}

TEST_CASE("among 64 lamps in a row, samples by contribution have a fourth of the variance") {
  const scene::Scene scene = floor_under_lamps(64);
  for (const Method& method : {path_light_samples, path}) {
    CAPTURE(name_of(method));
    render::Settings by_power = with(method, 2048, 1), by_contribution = with(method, 256, 2);
    by_power.light_selection = LightSelection::power;
    const Render before = render_of(scene, by_power), after = render_of(scene, by_contribution);
    check_agreement(tiles(estimate_of(after.film), 4), tiles(estimate_of(before.film), 4));
    CHECK(variance(after) < variance(before) / 4);
  }
}

TEST_CASE("roulette of connections leaves the image as it is, and traces fewer rays") {
  const scene::Scene scene = shipped("glossy-box", 32, 32);
  for (const Method& method : {bidir, bidir_uniform}) {
    CAPTURE(name_of(method));
    render::Settings all = with(method, 256, 1), few = with(method, 256, 2);
    all.connections = 0;
    few.connections = 1;
    const Render before = render_of(scene, all), after = render_of(scene, few);
    check_agreement(tiles(estimate_of(after.film), 4), tiles(estimate_of(before.film), 4));
    CHECK(after.statistics.shadow_rays < before.statistics.shadow_rays * 3 / 4);
  }
}
