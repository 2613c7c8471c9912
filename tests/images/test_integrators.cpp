// Light tracing and bidirectional path tracing agree with path tracing.
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/integrators.h"
#include "images/room.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

const std::vector<Method> all_methods = {light, bidir, bidir_power, bidir_uniform};
const std::vector<Method> weighted = {light, bidir};

// Side of the tiles in pixels: light tracing has enough hits in a tile for a normal mean, but maybe only ten
// in a pixel, if the sky is one of six lights.
constexpr int tile = 4;

} // namespace

// All in one room, so that they share a kernel; the shipped scenes test the kernels of single kinds.
TEST_CASE("every kind of emitter by itself: light and bidir agree with path") {
  for (const std::string& kind : emitter_kinds()) {
    CAPTURE(kind);
    check_against_path(room({kind}), weighted, settings_for(64), tile);
  }
}

// What tests/mutations/run.py runs.
TEST_CASE("a surface, a point and the sky together: light and bidir agree with path", "[mutations]") {
  check_against_path(room({"rectangle", "point", "constant"}), weighted, settings_for(64), tile);
}

TEST_CASE("several emitters together, by every way to weigh") {
  check_against_path(room({"rectangle", "mesh", "sphere", "spot", "constant"}), all_methods, settings_for(64),
                     tile);
  check_against_path(room({"disk", "point", "directional", "flipped", "inside"}), all_methods,
                     settings_for(64), tile);
}

TEST_CASE("each path length by itself agrees") {
  const scene::Scene scene = room({"mesh", "disk", "sphere", "point", "directional", "constant"});
  for (int depth = 1; depth <= 4; ++depth) {
    CAPTURE(depth);
    check_against_path(scene, all_methods, settings_for(32, depth), tile);
  }
}

TEST_CASE("roulette changes no expectation of light and bidir") {
  const scene::Scene scene = room({"rectangle", "constant"});
  render::Settings with = settings_for(32);
  with.rr_depth = -1;
  with.max_depth = 30; // longer paths contribute less than the noise
  const Repeated reference = repeated(scene, path, with);
  with.max_depth = -1;
  for (const int rr_depth : {1, 3}) {
    with.rr_depth = rr_depth;
    for (const Method& method : weighted) {
      CAPTURE(rr_depth, name_of(method));
      with.seed += 1000;
      check_methods(repeated(scene, method, with), reference, tile);
    }
  }
}

// By throughput light subpaths begin at 1, whatever their power.
TEST_CASE("every roulette leaves the expectation of light and bidir as it is, whatever the lights' power") {
  scene::Scene scene = room({"rectangle", "constant"});
  render::Settings with = settings_for(32);
  const Repeated reference = repeated(scene, path, with);
  with.rr_depth = 1;
  using render::Roulette;
  for (const auto& [roulette, method] :
       {std::pair(Roulette::kd_ks, light), std::pair(Roulette::throughput, bidir),
        std::pair(Roulette::efficiency, light), std::pair(Roulette::efficiency, bidir)}) {
    CAPTURE(render::roulette_names()[static_cast<std::size_t>(roulette)], name_of(method));
    with.roulette = roulette;
    with.seed += 1000;
    check_methods(repeated(scene, method, with), reference, tile);
  }
  const render::Settings of_light = by(light, with);
  const std::uint64_t rays = render_of(scene, of_light).statistics.rays;
  for (scene::AreaEmitter& emitter : scene.area_emitters) emitter.radiance *= 1024.0;
  *scene.constant_radiance *= 1024.0;
  CHECK(render_of(scene, of_light).statistics.rays == rays);
}

TEST_CASE("films of any shape, and a principal point off the centre") {
  scene::Scene scene = room({"rectangle", "sphere", "constant"});
  for (const auto& [width, height] : {std::pair(24, 8), std::pair(5, 31)}) {
    CAPTURE(width, height);
    scene.camera = look_at({0.3, 2, 5}, {0, 1, 0}, width > height ? 60 : 20, width, height);
    check_against_path(scene, weighted, settings_for(512));
  }
  scene.camera = look_at({0.3, 2, 5}, {0, 1, 0}, 40, 12, 18);
  scene.camera.principal_x = 0.2;
  scene.camera.principal_y = -0.15;
  check_against_path(scene, weighted, settings_for(512));
  scene.camera.left = -scene.camera.left; // mirrored
  check_against_path(scene, weighted, settings_for(512));
}

TEST_CASE("a light behind a blocker") {
  scene::Scene scene = room({"rectangle"});
  scene.patches.push_back(square({0.5, 2.3, 0.3}, {1, 0, 0}, {0, 0, 1}, 0.5, {3, -1})); // below it
  check_against_path(scene, weighted, settings_for(64), tile);
}

TEST_CASE("scenes of any size and in any place") {
  const scene::Scene scene = room({"mesh", "sphere", "point", "directional", "constant"});
  for (const auto& [scale, offset] :
       {std::pair(1e-3, Vec3(0.0)), std::pair(1e3, Vec3(0.0)), std::pair(1.0, Vec3(1e4, -1e4, 1e4)),
        std::pair(1e-3, Vec3(10, -20, 5))}) {
    CAPTURE(scale, offset.x);
    check_against_path(placed(scene, scale, offset), weighted, settings_for(32), tile);
  }
}

TEST_CASE("lights and spheres a thousand times smaller or larger than the rest") {
  scene::Scene tiny = room({"sphere", "rectangle"});
  tiny.spheres[1].radius *= 1e-3;
  tiny.spheres[1].center = {-0.3, 3.6,
                            1.2}; // out of view: a mean of hits with probability 1e-6 is not normal
  tiny.area_emitters[3].radiance *= 1e6;
  tiny.spheres[0].radius *= 1e-3;
  check_against_path(tiny, weighted, settings_for(64), tile);
  scene::Scene huge = room({"sphere", "rectangle"});
  huge.spheres[1] = {{0, 600, 100}, 300, false, huge.spheres[1].surface};
  huge.spheres[0] = {{0, -1000, 0}, 999, false, huge.spheres[0].surface};
  // One in 100,000 light paths from it enters the room: too few for a normal mean by light tracing.
  check_against_path(huge, {bidir}, settings_for(64), tile);
}

TEST_CASE("every shipped scene: light and bidir agree with path") {
  for (const std::string& name : shipped_names()) {
    const scene::Scene scene = shipped(name, 16, 16);
    // Light tracing shows mirrors and glass black, and path tracing rarely finds their caustics. See also
    // below.
    if (name == "caustic" || has_delta(scene)) continue;
    CAPTURE(name);
    check_against_path(scene, weighted, settings_for(64), tile);
  }
}

// One path in tens of thousands finds the caustic in path tracing: its means are not normal. Light tracing
// and bidirectional path tracing find it by different techniques. The reflector is out of view, because light
// tracing rarely connects its lobe to the eye.
TEST_CASE("the caustic: light and bidir agree with each other") {
  scene::Scene scene = shipped("caustic", 16, 16);
  scene.camera = look_at({0, 1, 3.9}, {-0.45, 0.7, 0}, 20, 16, 16);
  render::Settings with = settings_for(256);
  const Repeated reference = repeated(scene, light, with);
  with.seed = 1000;
  check_methods(repeated(scene, bidir, with), reference, tile);
}

// Light tracing shows the mirror black, and path tracing finds its caustic rarely.
TEST_CASE("the mirror ball: bidir's heuristics agree with each other, and light where no mirror is in view") {
  scene::Scene scene = shipped("mirror-ball", 16, 16);
  render::Settings with = settings_for(64);
  const Repeated reference = repeated(scene, bidir, with);
  with.seed = 1000;
  check_methods(repeated(scene, bidir_power, with), reference, tile);
  scene.camera = look_at({0, 0, 3.6}, {-0.4, -1, 0.7}, 4, 16, 16); // the floor in front of the mirror
  check_methods(repeated(scene, light, with), repeated(scene, bidir, settings_for(64)), tile);
}
