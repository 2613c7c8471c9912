// Delta events: a smooth mirror by path, light and bidirectional path tracing, against closed forms and each
// other. Light tracing cannot connect a mirror to the eye, so mirrors are out of its view.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/integrators.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

render::Settings with(const Method& method, int samples, int max_depth = -1) {
  return by(method, settings_for(samples, max_depth));
}

// A mirror of 3 x 3 on the plane x = -1, facing +x, beside a diffuse floor that the camera looks down on.
scene::Scene floor_beside_mirror(double albedo, const Rgb& reflectance) {
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(albedo)), lobes::mirror(reflectance)};
  scene.patches = {square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, {0, -1}),
                   square({-1, 1.5, 0}, {0, 1, 0}, {0, 0, 1}, 1.5, {1, -1})};
  scene.camera = look_at({0.2, 2, 0}, {0.2, 0, 0.01}, 25, 8, 8);
  return scene;
}

} // namespace

TEST_CASE("mirrors: a ball in a furnace shows the sky times its reflectance") {
  const Rgb reflectance(0.9, 0.5, 0.2), sky(1.0, 0.5, 2.0);
  scene::Scene scene = shipped("furnace-sphere", 6, 6);
  scene.camera = look_at({0, 0, 4}, {0, 0, 0}, 18, 6, 6); // nothing but the sphere
  scene.materials.assign(scene.materials.size(), lobes::mirror(reflectance));
  scene.constant_radiance = sky;
  const Rgb seen = reflectance * sky;
  for (const Method& method : {path, path_hits, path_light_samples, bidir, bidir_power, bidir_uniform}) {
    CAPTURE(name_of(method));
    const Render ball = render_of(scene, with(method, 16));
    CHECK(ball.statistics.nonfinite == 0);
    if (method.integrator == "path") CHECK(ball.statistics.shadow_rays == 0); // no light sample at a mirror
    check_agreement(estimate_of(ball.film), uniform(ball.film, {seen.r, seen.g, seen.b}), 1e-5);
  }
}

TEST_CASE("mirrors: a lossless ball in a closed furnace cannot be told from its walls, with roulette") {
  scene::Scene scene = shipped("furnace-box", 6, 6);
  scene.materials.push_back(lobes::mirror(Rgb(1.0)));
  scene.spheres.push_back(
      {{-0.3, -0.1, -0.6}, 0.25, false, {static_cast<int>(scene.materials.size()) - 1, -1}});
  for (const Method& method : {path, path_hits, bidir, bidir_power}) {
    CAPTURE(name_of(method));
    render::Settings settings = with(method, 1024);
    settings.rr_depth = 1;
    const Render box = render_of(scene, settings);
    check_agreement(estimate_of(box.film), uniform(box.film, {2, 2, 2}));
  }
}

TEST_CASE("mirrors: a floor is lit by a point light and by its image in a mirror") {
  const Rgb reflectance(0.8, 0.6, 0.3), intensity(5.0);
  constexpr double albedo = 0.5;
  scene::Scene scene = floor_beside_mirror(albedo, reflectance);
  const Vec3 lamp(0.5, 1, 0.3), image(-2 - lamp.x, lamp.y, lamp.z);
  scene.point_lights = {{lamp, intensity}};
  const auto irradiance = [&](const Vec3& from, const Vec3& at) {
    const Vec3 way = from - at;
    const double distance2 = glm::dot(way, way);
    return way.y / (distance2 * std::sqrt(distance2));
  };
  // Every ray from the image to the floor in view passes through the mirror: it is 3 x 3.
  const Estimate reference = expected(scene.camera, [&](const Vec3& direction) {
    const Vec3 at = scene.camera.position - direction * (scene.camera.position.y / direction.y);
    const Rgb seen = albedo / pi * intensity * (irradiance(lamp, at) + reflectance * irradiance(image, at));
    return Channels{seen.r, seen.g, seen.b};
  });
  for (const Method& method : {light, bidir, bidir_power, bidir_uniform}) {
    CAPTURE(name_of(method));
    const Render floor = render_of(scene, with(method, 4096, 3));
    check_agreement(estimate_of(floor.film), reference, 1e-4);
  }
}

TEST_CASE("mirrors: the caustic of a curved mirror is the same by path, light and bidir") {
  scene::Scene scene = floor_beside_mirror(0.6, Rgb(0.9));
  scene.patches.pop_back();
  scene.spheres = {{{-0.7, 0.5, 0}, 0.45, false, {1, -1}}, {{1.2, 1.5, 0}, 0.3, false, {0, 0}}};
  scene.area_emitters = {{Rgb(10.0)}};
  check_against_path(scene, {light, bidir, bidir_power}, settings_for(256), 2);
}

TEST_CASE("mirrors: a mirror between smooth normals and anisotropic lobes changes no integrator's mean") {
  scene::Scene scene = floor_beside_mirror(0.5, Rgb(0.7, 0.8, 0.9));
  scene.materials.push_back(lobes::anisotropic_phong(Rgb(0.3), Rgb(0.2), 5, 20));
  scene.patches.push_back(square({0.3, 0.3, 0.6}, {1, 0, 0}, {0, 0.8, 0.6}, 0.3, {2, -1}));
  scene.spheres = {{{1, 1.6, -0.5}, 0.4, false, {0, 0}}};
  scene.area_emitters = {{Rgb(6.0)}};
  check_against_path(scene, {bidir, bidir_power}, settings_for(256), 2);
}
