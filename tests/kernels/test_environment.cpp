// Environment maps: their radiance and density against float64, and sampled directions against the density.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "directions.h"
#include "questions.h"
#include "scene_test.h"

using namespace device_test;
using glm::dvec3;
using phlux::scene::EnvironmentMap;
using phlux::scene::Scene;

namespace {

constexpr double pi = std::numbers::pi;

EnvironmentMap map_of(int width, int height, Random& random) {
  EnvironmentMap map{width, height, {}, glm::dmat3(1.0), dvec3(2)};
  for (int i = 0; i < width * height; ++i)
    map.texels.emplace_back(random.uniform(), random.uniform(0, 2), random.uniform());
  return map;
}

glm::dmat3 turned(double mirror) {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(dvec3(1, -2, 0.5)));
  return glm::dmat3(turn) * glm::dmat3(mirror, 0, 0, 0, 1, 0, 0, 0, 1);
}

// Random texels; of 1 x 1; a sun; black rows, also at the poles; a single texel that is lit, at a pole.
std::vector<EnvironmentMap> maps() {
  Random random(81);
  std::vector<EnvironmentMap> list = {map_of(7, 5, random), map_of(1, 1, random),  map_of(3, 1, random),
                                      map_of(1, 2, random), map_of(16, 8, random), map_of(5, 6, random),
                                      map_of(4, 3, random)};
  list[0].to_world = turned(1);
  list[4].texels[37] *= 1e5F;
  list[4].to_world = turned(-1);
  for (int i = 0; i < 30; ++i)
    if (i < 5 || i >= 25 || i / 5 == 3) list[5].texels[static_cast<std::size_t>(i)] = glm::vec3(0);
  for (std::size_t i = 0; i < 12; ++i)
    if (i != 9) list[6].texels[i] = glm::vec3(0);
  return list;
}

Scene scene_under(const EnvironmentMap& map) {
  Scene scene;
  scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
  scene.spheres.push_back({dvec3(1, 2, 3), 2.0, false, {}});
  scene.environment = map;
  return scene;
}

// Bilinear interpolation in float64 of a function of a texel, at column `u` and row `v` of the image.
template<class Value>
auto interpolated(const EnvironmentMap& map, double u, double v, const Value& of) {
  const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), a = u - 0.5 - x, b = v - 0.5 - y;
  const auto at = [&](double column, double row) {
    const int c = (static_cast<int>(column) + map.width) % map.width;
    const int r = std::clamp(static_cast<int>(row), 0, map.height - 1);
    return of(dvec3(map.texels[static_cast<std::size_t>(r * map.width + c)]) * map.scale, r);
  };
  return (1 - b) * ((1 - a) * at(x, y) + a * at(x + 1, y)) +
         b * ((1 - a) * at(x, y + 1) + a * at(x + 1, y + 1));
}

dvec3 radiance_at(const EnvironmentMap& map, double u, double v) {
  return interpolated(map, u, v, [](const dvec3& texel, int) { return texel; });
}

// What the density is proportional to, per solid angle.
double importance_at(const EnvironmentMap& map, double u, double v) {
  const auto mean = [](const dvec3& texel) { return (texel.r + texel.g + texel.b) / 3; };
  if (v < 0.5 || v > map.height - 0.5) return mean(radiance_at(map, u, v));
  return interpolated(map, u, v,
                      [&](const dvec3& texel, int row) {
                        return mean(texel) * std::sin((row + 0.5) * pi / map.height);
                      }) /
         std::sin(v * pi / map.height);
}

// Integrals of the importance over the quarters of texels: bilinear in u and v after the change of measure.
std::vector<double> quarters(const EnvironmentMap& map) {
  std::vector<double> integrals;
  for (int j = 0; j < 2 * map.height; ++j)
    for (int i = 0; i < 2 * map.width; ++i) {
      const double u = i / 2.0 + 0.25, v = j / 2.0 + 0.25, row = pi / map.height;
      const bool cap = j == 0 || j == 2 * map.height - 1;
      const double across = cap ? 1 - std::cos(row / 2) : row / 2 * std::sin(v * row);
      integrals.push_back(importance_at(map, u, v) * across * pi / map.width);
    }
  return integrals;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// Column and row of a direction, as Mitsuba's envmap has them.
glm::dvec2 place_of(const EnvironmentMap& map, const dvec3& direction) {
  const dvec3 local = glm::transpose(map.to_world) * direction;
  const double turn = std::atan2(local.x, -local.z) / (2 * pi);
  return {(turn - std::floor(turn)) * map.width,
          std::atan2(std::hypot(local.x, local.z), local.y) / pi * map.height};
}

} // namespace

TEST_CASE("environment maps: radiance and density are those of float64") {
  for (const Variant v : variants)
    for (const EnvironmentMap& map : maps()) {
      CAPTURE(v, map.width, map.height);
      Random random(82);
      const SceneProgram program(v, "environment.cl", scene_under(map));
      std::vector<Float3> directions = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}, {-0.0F, 0, 1}};
      while (directions.size() < thinned(4000)) directions.push_back(to_float(random.direction()));
      std::vector<Float3> radiance(directions.size());
      std::vector<float> density(directions.size());
      program.run("look_at_map", directions.size(), directions, out(radiance), out(density));
      const double total = sum_of(quarters(map));
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec2 place = place_of(map, to_double(directions[i]));
        CAPTURE(i, place.x, place.y);
        const dvec3 right = radiance_at(map, place.x, place.y);
        const double largest = std::max({right.r, right.g, right.b});
        // Rounding moves a direction by some 2^-22 rows and columns of the largest texel.
        const double margin = largest > 100 ? 0.5 : 1e-5;
        REQUIRE(glm::length(to_double(radiance[i]) - right) <= margin);
        REQUIRE(std::abs(density[i] * total - importance_at(map, place.x, place.y)) <= margin);
      }
    }
}

TEST_CASE("environment maps: directions are sampled with their density") {
  const std::vector<EnvironmentMap> list = maps();
  for (const Variant v : variants)
    for (const EnvironmentMap& map : list) {
      CAPTURE(v, map.width, map.height);
      Random random(83);
      const SceneProgram program(v, "environment.cl", scene_under(map));
      const std::size_t count = thinned(200'000);
      std::vector<std::uint32_t> path(count);
      for (std::size_t i = 0; i < count; ++i) path[i] = static_cast<std::uint32_t>(i);
      std::vector<Float3> directions(count);
      const cl_uint2 seed = {{random.word(), 0}};
      program.run("sample_map", count, seed, path, out(directions));
      std::vector<double> expected = quarters(map), observed(expected.size(), 0.0);
      const double total = sum_of(expected);
      for (double& value : expected) value *= static_cast<double>(count) / total;
      for (const Float3& direction : directions) {
        REQUIRE(std::abs(glm::length(to_double(direction)) - 1) < 5e-7);
        const glm::dvec2 place = place_of(map, to_double(direction));
        const auto cell = [](double at, int texels) {
          return std::clamp(static_cast<int>(std::floor(2 * at)), 0, 2 * texels - 1);
        };
        observed[static_cast<std::size_t>(cell(place.y, map.height) * 2 * map.width +
                                          cell(place.x, map.width))] += 1;
      }
      CHECK(chi_square_p(observed, expected) > one_of(list.size() * std::size(variants)));
    }
}
