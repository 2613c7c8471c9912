// Common mistakes in light tracing and bidirectional path tracing: borders of the film, corners,
// sides of surfaces, visible lights, lights that cannot be hit, missing lights.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/integrators.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

constexpr double pi = std::numbers::pi;
const std::vector<Method> splatting = {light, bidir, bidir_power, bidir_uniform};

Estimate image_of(const scene::Scene& scene, const render::Settings& settings) {
  const Render render = render_of(scene, settings);
  CHECK(render.statistics.nonfinite == 0);
  return estimate_of(render.film);
}

double brightest(const Estimate& image) {
  double most = 0;
  for (const Channels& mean : image.mean) most = std::max({most, mean[0], mean[1], mean[2]});
  return most;
}

scene::Scene plane_under(const scene::Material& material, int width, int height) {
  scene::Scene scene;
  scene.materials = {material, diffuse(Rgb(0.0))};
  scene.patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, {})};
  scene.camera = look_at({0.1, -0.2, 2}, {0.1, -0.19, 0}, 50, width, height);
  return scene;
}

} // namespace

// The emitter extends beyond the film on every side: light from just outside must not be added to pixels at
// the border.
TEST_CASE("an emitter that fills the film shows its radiance in every pixel, the borders' as well") {
  scene::Scene scene = plane_under(diffuse(Rgb(0.0)), 9, 6);
  scene.area_emitters = {{Rgb(3, 2, 1)}};
  scene.patches[0].surface = {1, 0};
  for (const int max_depth : {1, -1})
    for (const Method& method : splatting) {
      CAPTURE(max_depth, name_of(method));
      const Render seen = render_of(scene, settings_for(method, 4096, max_depth));
      check_agreement(estimate_of(seen.film), uniform(seen.film, {3, 2, 1}));
    }
}

TEST_CASE("a plane under the sun is as bright at the film's borders as inside") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.5, 0.2}), 9, 6);
  scene.directional_lights = {{glm::normalize(Vec3(1, 2, -2)), {3, 2, 1}}};
  const double part = 2.0 / 3.0 / pi;
  for (const Method& method : splatting) {
    CAPTURE(name_of(method));
    const Render lit = render_of(scene, settings_for(method, 4096));
    check_agreement(estimate_of(lit.film), uniform(lit.film, {0.8 * 3 * part, 0.5 * 2 * part, 0.2 * part}));
  }
}

TEST_CASE("a sky that the eye sees past the shapes") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.5, 0.2}), 8, 8);
  scene.camera = look_at({0, 0, 2}, {6, 0, 1.5}, 90, 8, 8);
  scene.constant_radiance = Rgb(1, 2, 3);
  check_against_path(scene, splatting, settings_for(256));
  check_against_path(scene, splatting, settings_for(64, 1));
}

TEST_CASE("a lamp in view, at the film's edge and partly beyond it") {
  scene::Scene scene = plane_under(phong({0.5, 0.3, 0.1}, {0.3, 0.1, 0.6}, 10), 12, 12);
  scene.area_emitters = {{Rgb(5, 4, 3)}};
  scene.spheres = {{{0.75, -0.2, 0.6}, 0.25, false, {1, 0}}};
  check_against_path(scene, splatting, settings_for(128), 2);
}

// 1 / distance^2 is unbounded where walls meet: the variance is finite with balance and power, infinite with
// uniform.
TEST_CASE("a corner in the middle of the film") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.7, 0.6}), 8, 8);
  scene.patches.push_back(square({0, 3, 3}, {1, 0, 0}, {0, 0, 1}, 3, {})); // faces -y
  scene.camera = look_at({0.2, 1, 1}, {0, 3, 0}, 30, 8, 8);
  scene.area_emitters = {{Rgb(9, 8, 7)}};
  scene.patches.push_back(square({0, 1, 2.5}, {0, 1, 0}, {1, 0, 0}, 0.3, {1, 0}));
  check_against_path(scene, {light, bidir, bidir_power}, settings_for(256), 2);
}

// A connection of a point on the back with one on the front runs along the surface, up to rounding. The light
// that leaks is in proportion to the square of the rounding.
TEST_CASE("a surface seen from behind is black, though light falls on its front") {
  constexpr double rounding_squared = 1e-10; // relative to the radiance of the lit side, about 0.5
  for (const bool two_sided : {false, true}) {
    scene::Scene scene = plane_under(diffuse({0.8, 0.5, 0.2}), 8, 8);
    scene.materials[0].two_sided = two_sided;
    scene.camera = look_at({0, 0, -2}, {0.1, 0, 0}, 50, 8, 8);
    for (const Method& method : splatting) {
      CAPTURE(two_sided, name_of(method));
      scene.point_lights = {{{0.3, -0.2, 1.5}, {3, 2, 1}}};
      CHECK(brightest(image_of(scene, settings_for(method, 64))) <= (two_sided ? rounding_squared : 0));
      scene.point_lights[0].position.z = -1.5; // on the camera's side: the back reflects if two-sided
      CHECK((brightest(image_of(scene, settings_for(method, 64))) > 0.1) == two_sided);
    }
  }
}

TEST_CASE("an emitter seen from behind is black, and lights what it faces alone") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.5, 0.2}), 8, 8);
  scene.area_emitters = {{Rgb(5.0)}};
  scene.patches.push_back(
      square({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 0.2, {1, 0})); // faces the camera, not the plane
  for (const Method& method : splatting) {
    CAPTURE(name_of(method));
    const Estimate image = image_of(scene, settings_for(method, 64));
    CHECK(image.mean.front() == Channels{});
    scene::Scene turned = scene;
    turned.patches[1].edge_u = -turned.patches[1].edge_u;
    const Estimate other = image_of(turned, settings_for(method, 64));
    CHECK(other.mean.front()[0] > 0);
    CHECK(is_black(render_of(turned, settings_for(method, 64, 1)).film));
  }
}

// With interpolated normals light subpaths need the adjoint of f cos (Veach 1997, 5.3). The lamp lights only
// the ball, and the ball lights the floor.
TEST_CASE("a ball of eight triangles with a ball's normals, and the floor in its light") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.7, 0.6}), 12, 12);
  scene::Mesh ball;
  for (const Vec3& p :
       {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    ball.positions.push_back(p + Vec3(0, 0, 1.3));
    ball.normals.emplace_back(p);
  }
  ball.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  scene.meshes = {ball};
  scene.spot_lights = {{{3, 0.4, 1.3}, glm::normalize(Vec3(-1, -0.1, 0)), Rgb(90, 80, 70), 0.2, 0.15}};
  scene.camera = look_at({2.5, 3, 3.5}, {0.4, 0, 0.7}, 40, 12, 12);
  check_against_path(scene, {light, bidir}, settings_for(256), 2);
}

// Light arrives at grazing angles and leaves near the normal, so the densities of the two directions, which
// the weights use, differ. The point light is so near that hits of it, if they were counted as a technique,
// would have a large weight.
TEST_CASE("a low gap lit from its side: bidir agrees with path") {
  scene::Scene scene = plane_under(diffuse({0.9, 0.8, 0.7}), 8, 8);
  scene.patches.push_back(
      {scene::Patch::Region::parallelogram, {0.9, 0, 0.6}, {0, 3, 0}, {2.1, 0, 0}, {0, -1}}); // faces down
  scene.area_emitters = {{Rgb(5, 4, 3)}};
  scene.patches.push_back(
      {scene::Patch::Region::parallelogram, {3.2, 0, 0.3}, {0, 0, 0.25}, {0, 3, 0}, {1, 0}}); // faces -x
  scene.point_lights = {{{0.5, 0, 0.2}, Rgb(0.5, 1, 1.5)}};
  scene.camera = look_at({-2.2, 0.1, 2.5}, {-1.7, 0, 0}, 40, 8, 8);
  check_against_path(scene, {bidir, bidir_power}, settings_for(512), 2);
}

TEST_CASE("a spot light in closed form: its beam, its fall-off, and dark beyond") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.5, 0.2}), 8, 8);
  const Vec3 position(0.1, -0.3, 1.5), axis = glm::normalize(Vec3(0.1, 0.2, -1)), eye = scene.camera.position;
  const double cutoff = 0.5, beam = 0.2;
  scene.spot_lights = {{position, axis, {3, 2, 1}, cutoff, beam}};
  const Estimate reference = expected(
      scene.camera,
      [&](const Vec3& direction) {
        const Vec3 way = eye - eye.z / direction.z * direction - position;
        const double distance = glm::length(way),
                     angle = std::acos(std::min(1.0, glm::dot(axis, way) / distance));
        const double falloff = std::clamp((cutoff - angle) / (cutoff - beam), 0.0, 1.0);
        const Rgb value =
            Rgb(0.8 * 3, 0.5 * 2, 0.2) * (falloff * -way.z / (pi * distance * distance * distance));
        return Channels{value.r, value.g, value.b};
      },
      64);
  for (const Method& method : splatting) {
    CAPTURE(name_of(method));
    // In tiles: a pixel that the edge only touches is reached by a path or two, so its mean is not normal.
    check_agreement(tiles(image_of(scene, settings_for(method, 4096)), 4), tiles(reference, 4), 2e-4);
  }
}

TEST_CASE("no light, lights without power, nothing in view: black, and no crash") {
  scene::Scene dark = plane_under(diffuse({0.8, 0.5, 0.2}), 4, 4);
  scene::Scene unpowered = dark;
  unpowered.area_emitters = {{Rgb(0.0)}};
  unpowered.patches.push_back(square({0, 0, 1.5}, {0, 1, 0}, {1, 0, 0}, 0.2, {1, 0}));
  unpowered.point_lights = {{{0, 0, 1}, Rgb(0.0)}};
  unpowered.constant_radiance = Rgb(0.0);
  scene::Scene looks_away = dark;
  looks_away.point_lights = {{{0, 0, 1}, Rgb(1.0)}};
  looks_away.camera = look_at({0, 0, 2}, {0, 0, 5}, 50, 4, 4);
  scene::Scene absorbs = looks_away; // the light
  absorbs.camera = dark.camera;
  absorbs.materials[0] = diffuse(Rgb(0.0));
  for (const Method& method : {path, light, bidir, bidir_power, bidir_uniform})
    for (const scene::Scene* scene : {&dark, &unpowered, &looks_away, &absorbs}) {
      CAPTURE(name_of(method), scene->camera.position.z, scene->point_lights.size());
      const Render black = render_of(*scene, settings_for(method, 8));
      CHECK(black.statistics.nonfinite == 0);
      CHECK(black.statistics.paths == 128);
      CHECK(is_black(black.film));
    }
}

TEST_CASE("a light without power next to one that has some changes nothing") {
  scene::Scene scene = plane_under(diffuse({0.8, 0.5, 0.2}), 8, 8);
  scene.directional_lights = {{glm::normalize(Vec3(1, 2, -2)), {3, 2, 1}}};
  scene.point_lights = {{{0, 0, 1}, Rgb(0.0)}};
  const double part = 2.0 / 3.0 / pi;
  for (const Method& method : splatting) {
    CAPTURE(name_of(method));
    const Render lit = render_of(scene, settings_for(method, 2048));
    check_agreement(estimate_of(lit.film), uniform(lit.film, {0.8 * 3 * part, 0.5 * 2 * part, 0.2 * part}));
  }
}
