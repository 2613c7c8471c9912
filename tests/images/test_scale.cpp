// An image depends neither on the unit of length nor on the position of the scene, and closed boxes leak no
// light.
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "images/evidence.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

Estimate image_of(const scene::Scene& scene, std::uint64_t seed) {
  render::Settings with = settings_for(512);
  with.seed = seed;
  return tiles(estimate_of(render_of(scene, with).film), 2);
}

// A closed box about the origin, turned so that no coordinate is round; its walls reflect inwards.
std::vector<scene::Patch> closed_box(double half, int material) {
  const Vec3 x = glm::normalize(Vec3(3, 1, 2)), y = glm::normalize(glm::cross(x, Vec3(0, 1, 0.3)));
  const Vec3 z = glm::cross(x, y);
  std::vector<scene::Patch> walls;
  for (const auto& [u, v, w] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}})
    for (const double sign : {1.0, -1.0})
      walls.push_back(square(sign * half * w, v, sign * u, half, {material, -1}));
  return walls;
}

} // namespace

TEST_CASE("scenes of any size and in any place give the same image") {
  for (const std::string name : {"glossy-box", "point-light"}) {
    CAPTURE(name);
    const scene::Scene scene = shipped(name, 16, 16);
    const Estimate reference = image_of(scene, 1);
    for (const double scale : {1e-3, 1e3}) {
      CAPTURE(scale);
      check_agreement(image_of(placed(scene, scale, Vec3(0.0)), 2), reference);
    }
    check_agreement(image_of(placed(scene, 1, Vec3(1e4, -1e4, 1e4)), 3), reference);
    check_agreement(image_of(placed(scene, 1e-3, Vec3(10, -20, 5)), 4), reference);
  }
}

TEST_CASE("lights of any brightness give the same image, bit for bit, in their unit") {
  scene::Scene scene = shipped("glossy-box", 16, 16);
  scene.point_lights = {{{0, 0.5, 0}, Rgb(0.5)}};
  scene.spot_lights = {{{0, 0.5, 0.2}, {0, -1, 0}, Rgb(2), 0.5, 0.4}};
  scene.directional_lights = {{glm::normalize(Vec3(1, -3, -1)), Rgb(0.25)}};
  scene.constant_radiance = Rgb(0.125);
  for (const auto& [integrator, ambient] :
       {std::pair("path", std::optional<double>()), std::pair("path", std::optional(0.5)),
        std::pair("light", std::optional<double>()), std::pair("bidir", std::optional<double>())}) {
    render::Settings with = settings_for(64);
    with.integrator = integrator;
    with.ambient = ambient;
    const Render reference = render_of(scene, with);
    for (const double factor : {0x1p-90, 0x1p90}) { // squares out of the range of float32
      CAPTURE(factor, integrator, ambient.has_value());
      scene::Scene lit = scene;
      for (scene::AreaEmitter& light : lit.area_emitters) light.radiance *= factor;
      for (scene::PointLight& light : lit.point_lights) light.intensity *= factor;
      for (scene::SpotLight& light : lit.spot_lights) light.intensity *= factor;
      for (scene::DirectionalLight& light : lit.directional_lights) light.irradiance *= factor;
      lit.constant_radiance = Rgb(0.125 * factor);
      if (ambient) with.ambient = factor * *ambient;
      const Render render = render_of(lit, with);
      int different = 0;
      for (std::size_t pixel = 0; pixel < render.film.pixels().size(); ++pixel)
        for (std::size_t channel = 0; channel < 3; ++channel)
          different += render.film.mean(pixel)[channel] != factor * reference.film.mean(pixel)[channel];
      CHECK(different == 0);
      CHECK(render.film.relative_standard_error() == reference.film.relative_standard_error());
    }
  }
}

TEST_CASE("a closed dark box next to a bright light stays dark") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    CAPTURE(scale);
    scene::Scene scene;
    scene.materials = {diffuse({0.9, 0.9, 0.9}), diffuse(Rgb(0.0))};
    scene.patches = closed_box(1, 0);
    scene.area_emitters = {{Rgb(1e6)}};
    scene.spheres = {{{2.3, 0, 0}, 0.5, false, {1, 0}}};
    scene.point_lights = {{{0, 1.8, 0}, Rgb(1e6)}};
    scene.directional_lights = {{{0.6, 0.8, 0}, Rgb(1e6)}};
    scene.camera = look_at({0.1, 0.05, 0.2}, {0.7, -0.5, -0.6}, 100, 16, 16);
    const Render dark = render_of(placed(scene, scale, Vec3(0.0)), settings_for(256));
    CHECK(dark.statistics.rays > 4 * dark.statistics.paths);
    int lit = 0;
    for (const film::Pixel& pixel : dark.film.pixels()) lit += pixel.sum != Channels{};
    CHECK(lit == 0);
  }
}

// The radiance of a convex body under a constant sky is its albedo times the sky; rays that hit it again at
// their origin would darken it.
TEST_CASE("a ground that is a sphere of radius 10,000 has no spots") {
  scene::Scene scene;
  scene.materials = {diffuse({0.8, 0.5, 0.2})};
  scene.spheres = {{{3, 7, -1e4}, 1e4, false, {}}};
  scene.constant_radiance = Rgb(1, 2, 3);
  scene.camera = look_at({3, 7, 2}, {3.1, 7.2, 0}, 60, 16, 16);
  const Render under_sky = render_of(scene, settings_for(64));
  check_agreement(estimate_of(under_sky.film), uniform(under_sky.film, {0.8, 1.0, 0.6}));

  scene.constant_radiance.reset();
  scene.directional_lights = {{glm::normalize(Vec3(4, 0, -3)), Rgb(1, 2, 3)}};
  const Render under_sun = render_of(scene, settings_for(64));
  const double part = 0.6 / std::numbers::pi;
  check_agreement(estimate_of(under_sun.film), uniform(under_sun.film, {0.8 * part, 1.0 * part, 0.6 * part}),
                  1e-3); // the ground's normal turns by 1e-4 a metre
}
