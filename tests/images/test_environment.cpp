// Environment maps by path, light and bidirectional path tracing, against closed forms and each other.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "images/evidence.h"
#include "images/furnaces.h"
#include "images/stability.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

glm::dmat3 turned(double angle, const Vec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
}

scene::EnvironmentMap uniform_map(int width, int height, const Rgb& radiance) {
  return {width, height, std::vector(static_cast<std::size_t>(width * height), glm::vec3(radiance)),
          turned(0.7, {1, 2, -1}), Rgb(1.0)};
}

// The unit sphere alone, with the kernels of sun.xml: its ground is inside the sphere.
scene::Scene sphere_under_map(const scene::Material& material) {
  scene::Scene scene = stability("sun", {{"width", "4"}, {"height", "4"}});
  scene.spheres[0].center = Vec3(0.0);
  scene.spheres[0].radius = 1;
  scene.patches[0].origin = Vec3(0.0);
  scene.patches[0].edge_u *= 1e-2;
  scene.patches[0].edge_v *= 1e-2;
  scene.materials[static_cast<std::size_t>(scene.spheres[0].surface.material)] = material;
  scene.camera = look_at({0, 0, 4}, {0, 0, 0}, 18, 4, 4);
  return scene;
}

// Irradiance at a normal from a texel of radiance 1, by the midpoint rule.
double irradiance_of_texel(const scene::EnvironmentMap& map, int column, int row, const Vec3& normal) {
  constexpr int points = 64;
  double irradiance = 0;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double across = (2 * i + 1.0) / points - 1, down = (2 * j + 1.0) / points - 1;
      const double phi = (column + 0.5 + across) * 2 * pi / map.width;
      const double theta = (row + 0.5 + down) * pi / map.height;
      const Vec3 direction = map.to_world * Vec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                                 -std::sin(theta) * std::cos(phi));
      irradiance += (1 - std::abs(across)) * (1 - std::abs(down)) *
                    std::max(glm::dot(direction, normal), 0.0) * std::sin(theta);
    }
  return irradiance * (4 * pi / map.width / points) * (2 * pi / map.height / points);
}

const std::vector<Method> methods = {path, path_hits, path_light_samples, light, bidir};

} // namespace

TEST_CASE("environment maps: a uniform one is a constant sky") {
  const scene::Material material = test::phong({0.3, 0.1, 0.0}, {0.6, 0.2, 0.9}, 10);
  const Estimate reference = sphere_reference(sphere_furnace(18, 4, material), material);
  scene::Scene scene = sphere_under_map(material);
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(6, 5)})
    for (const Method& method : methods) {
      CAPTURE(width, height, name_of(method));
      scene.environment = uniform_map(width, height, {test::sky[0], test::sky[1], test::sky[2]});
      const Render sphere = render_of(scene, settings_for(method, 2048));
      CHECK(sphere.statistics.nonfinite == 0);
      check_agreement(estimate_of(sphere.film), reference, 1e-4);
    }
}

TEST_CASE("environment maps: a diffuse sphere under a single texel reflects its irradiance") {
  const Rgb albedo(0.5, 0.7, 0.9), radiance(3, 50, 1000);
  constexpr int width = 8, height = 4, column = 5, row = 1;
  scene::EnvironmentMap map = uniform_map(width, height, Rgb(0.0));
  map.texels[row * width + column] = glm::vec3(radiance);
  scene::Scene scene = sphere_under_map(test::phong(albedo, Rgb(0.0), 1));
  scene.environment = map;
  const Estimate reference = expected(
      scene.camera,
      [&](const Vec3& direction) {
        const Vec3 normal =
            4.0 * Vec3(0, 0, 1) + direction * (-4 * direction.z - cosine_on_sphere(direction));
        const Rgb seen = albedo / pi * irradiance_of_texel(map, column, row, normal) * radiance;
        return Channels{seen.r, seen.g, seen.b};
      },
      8);
  CHECK(reference.mean[5][2] > 1);
  for (const Method& method : methods) {
    CAPTURE(name_of(method));
    const Render sphere = render_of(scene, settings_for(method, 4096));
    CHECK(sphere.statistics.nonfinite == 0);
    check_agreement(estimate_of(sphere.film), reference, 1e-3);
  }
}

// Bright at the horizon, black below, with a sun of one texel; a mirror out of view throws a caustic.
TEST_CASE("environment maps: with lamps and a mirror, light and bidir agree with path") {
  scene::EnvironmentMap map{12, 6, {}, turned(0.4, {0.2, 1, 0.3}), Rgb(0.5)};
  for (int i = 0; i < 6 * 12; ++i)
    map.texels.push_back(i / 12 > 2 ? glm::vec3(0)
                                    : static_cast<float>(1 + i / 12) * glm::vec3(0.3, 0.4, 0.6));
  map.texels[1 * 12 + 7] = glm::vec3(50, 45, 35);
  scene::Scene scene;
  scene.materials = {diffuse(Rgb(0.6)), lobes::conductor(Rgb(0.9))};
  scene.patches = {square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, {0, -1})};
  scene.spheres = {{{-0.7, 0.5, 0}, 0.45, false, {1, -1}}, {{1.3, 0.6, 0.2}, 0.2, false, {0, 0}}};
  scene.area_emitters = {{Rgb(4, 3, 2)}};
  scene.point_lights = {{{0.5, 1.2, 0.7}, Rgb(0.4)}};
  scene.camera = look_at({0.3, 2, 0}, {0.3, 0, 0.01}, 30, 8, 8);
  scene.environment = map;
  check_against_path(scene, {light, bidir}, settings_for(256), 2);
}
