// light_sample and light_density_of_hit compared with each other and with float64.
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "directions.h"
#include "questions.h"
#include "scene_test.h"

using namespace device_test;
using glm::dvec3;
using phlux::scene::Patch;
using phlux::scene::Scene;

namespace {

constexpr double pi = std::numbers::pi;

struct Sampled {
  Float3 origin, direction, radiance;
  float distance, density;
  int hittable, valid, blocked, light;
  float hit_density;
  int chosen;
  float choice;
};

enum class Shape { rectangle, triangle, disk, sphere, inside_of_sphere };
constexpr Shape shapes[] = {Shape::rectangle, Shape::triangle, Shape::disk, Shape::sphere,
                            Shape::inside_of_sphere};

constexpr double size = 1.5;
const dvec3 edge_u(size, 0, 0), edge_v(0.2 * size, 0.8 * size, 0); // all flat lights face z

// Adds a light with distinct radiance.
void add_light(Scene& scene, Shape shape, const dvec3& at) {
  const auto index = static_cast<int>(scene.area_emitters.size());
  scene.area_emitters.push_back({dvec3(1, 2, 3) * (1.0 + index)});
  const phlux::scene::Surface surface{0, index};
  if (shape == Shape::rectangle)
    scene.patches.push_back({Patch::Region::parallelogram, at, edge_u, edge_v, surface});
  if (shape == Shape::disk) scene.patches.push_back({Patch::Region::ellipse, at, edge_u, edge_v, surface});
  if (shape == Shape::triangle)
    scene.meshes.push_back({{at, at + edge_u, at + edge_v}, {}, {{0, 1, 2}}, surface});
  if (shape == Shape::sphere || shape == Shape::inside_of_sphere)
    scene.spheres.push_back({at, size, shape == Shape::inside_of_sphere, surface});
}

Scene scene_of(Shape shape) {
  Scene scene;
  scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
  add_light(scene, shape, dvec3(0));
  return scene;
}

// Points that see the light's front, from a hundredth of its size to a hundred times, in the scene's
// coordinates.
std::vector<dvec3> lit_points(Shape shape, std::size_t count, Random& random) {
  std::vector<dvec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double far = size * std::exp2(random.uniform(-6, 6));
    if (shape == Shape::inside_of_sphere)
      points.push_back(size * random.uniform(0, 0.99) * random.direction());
    else if (shape == Shape::sphere)
      points.push_back((size + far) * random.direction());
    else
      points.push_back(2 * size * random.uniform() * dvec3(glm::dvec2(random.point()), 0) +
                       far * random.direction_above());
  }
  return points;
}

// With this normal, or with any.
std::vector<Sampled> sample(const SceneProgram& program, const std::vector<dvec3>& points,
                            std::optional<dvec3> normal, Random& random) {
  std::vector<Float3> positions, normals;
  std::vector<std::uint32_t> paths;
  for (const dvec3& point : points) {
    positions.push_back(to_float(point));
    normals.push_back(to_float(normal.value_or(random.direction())));
    paths.push_back(static_cast<std::uint32_t>(paths.size()));
  }
  std::vector<Sampled> sampled(points.size());
  const cl_uint2 seed = {{random.word(), 0}};
  program.run("sample_lights", points.size(), positions, normals, seed, paths, out(sampled));
  return sampled;
}

// Point on a flat light as two numbers that are uniform in (0, 1) if points are uniform over its area.
glm::dvec2 square_of(Shape shape, const dvec3& point) {
  const double v = point.y / edge_v.y, u = (point.x - v * edge_v.x) / edge_u.x;
  if (shape == Shape::rectangle) return {(u + 1) / 2, (v + 1) / 2};
  if (shape == Shape::triangle) return {(1 - u) * (1 - u), v / (1 - u)};
  return {u * u + v * v, std::atan2(v, u) / (2 * pi) + 0.5};
}

// Error of a density distance^2 / (cosine area): rays end above the light by about 1e-6 of its largest
// coordinate and of their length.
double density_slack(double distance, double cosine, double extent = 2 * size) {
  return 1e-5 + 6e-6 * (distance + extent) / (cosine * distance);
}

void check_flat(Shape shape, const SceneProgram& program, const std::vector<dvec3>& points,
                const std::vector<Sampled>& sampled) {
  const dvec3 origin = program.host().geometry->origin;
  const double area = program.host().lights.records.at(0).area;
  constexpr int cells = 8;
  std::vector<double> observed(cells * cells, 0.0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    const Sampled& s = sampled[i];
    if (s.valid == 0) continue;
    const dvec3 from = to_double(s.origin) + origin, direction = to_double(s.direction);
    const double distance = from.z / -direction.z, cosine = -direction.z;
    CAPTURE(i, distance, cosine, points[i].z);
    const double right = distance * distance / (cosine * area);
    REQUIRE(std::abs(s.density / right - 1) <= density_slack(distance, cosine));
    const glm::dvec2 square = square_of(shape, from + distance * direction);
    const auto cell = [](double x) { return std::clamp(static_cast<int>(x * cells), 0, cells - 1); };
    observed[static_cast<std::size_t>(cell(square.x) * cells + cell(square.y))] += 1;
    ++count;
  }
  CHECK(count > sampled.size() * 9 / 10);
  const std::vector<double> expected(observed.size(), static_cast<double>(count) / (cells * cells));
  CHECK(chi_square_p(observed, expected) > one_of(3 * std::size(variants)));
}

void check_sphere(const std::vector<dvec3>& points, const std::vector<Sampled>& sampled) {
  constexpr std::size_t cells = 32;
  std::vector<double> observed(cells, 0.0);
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    const Sampled& s = sampled[i];
    CAPTURE(i, glm::length(points[i]));
    REQUIRE(s.valid == 1);
    const double sine = size / glm::length(points[i]);
    const double cone = sine * sine / (1 + std::sqrt(1 - sine * sine)); // 1 - cosine
    // sqrt(1 - sine^2) is inaccurate next to the surface.
    REQUIRE(std::abs(s.density * 2 * pi * cone - 1) <= 1e-6 + 1e-6 / std::sqrt(1 - sine * sine));
    const dvec3 to_center = -glm::normalize(points[i]);
    const double across = glm::length(glm::cross(to_center, to_double(s.direction)));
    const double drop = across * across / (1 + std::sqrt(std::max(0.0, 1 - across * across)));
    observed[std::min(static_cast<std::size_t>(drop / cone * cells), cells - 1)] += 1;
  }
  const std::vector<double> expected(cells, static_cast<double>(sampled.size()) / cells);
  CHECK(chi_square_p(observed, expected) > one_of(std::size(variants)));
}

} // namespace

TEST_CASE("lights: a sample's density is that of the hit of the same ray, and of the geometry") {
  for (const Variant v : variants)
    for (const Shape shape : shapes) {
      CAPTURE(v, static_cast<int>(shape));
      Random random(71);
      const SceneProgram program(v, "lights.cl", scene_of(shape));
      const dvec3 origin = program.host().geometry->origin;
      auto points = lit_points(shape, thinned(10000), random);
      for (dvec3& point : points) point = to_double(to_float(point - origin)) + origin;
      std::vector<dvec3> about_origin;
      for (const dvec3& point : points) about_origin.push_back(point - origin);
      const auto sampled = sample(program, about_origin, {}, random);
      std::size_t lost = 0, valid = 0;
      for (std::size_t i = 0; i < sampled.size(); ++i) {
        const Sampled& s = sampled[i];
        if (s.valid == 0) continue;
        ++valid;
        CAPTURE(i, points[i].x, points[i].y, points[i].z, s.distance);
        REQUIRE(s.hittable == 1);
        REQUIRE(s.blocked == 0); // by the light itself
        REQUIRE(std::abs(glm::length(to_double(s.direction)) - 1) < 3e-7);
        if (s.light != 0) { // misses the edge of the light by rounding
          ++lost;
          continue;
        }
        const double cosine = shape <= Shape::disk ? std::abs(s.direction.z) : 1;
        REQUIRE(std::abs(s.hit_density / s.density - 1) <= density_slack(s.distance, cosine));
      }
      CHECK(lost <= valid / 200);
      if (shape == Shape::sphere) check_sphere(points, sampled);
      if (shape <= Shape::disk) check_flat(shape, program, points, sampled);
    }
}

namespace {

// Five area lights, point and spot lights, and distant ones.
Scene scene_of_many() {
  Scene scene;
  scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
  for (int i = 0; i < 5; ++i) add_light(scene, shapes[i], dvec3(8 * i, 0, 0));
  scene.point_lights.push_back({dvec3(3, 3, 5), dvec3(60)});
  scene.point_lights.push_back({dvec3(5, -3, 5), dvec3(0)}); // without power: never chosen
  scene.spot_lights.push_back({dvec3(9, 3, 6), glm::normalize(dvec3(1, 2, -3)), dvec3(90), 0.5, 0.3});
  scene.directional_lights.push_back({dvec3(0, 0, -1), dvec3(0.5)});
  scene.constant_radiance = dvec3(0.25);
  return scene;
}

phlux::render::Settings choosing_by(phlux::render::LightSelection selection,
                                    phlux::render::Connect connect = phlux::render::Connect::mis) {
  phlux::render::Settings settings;
  settings.connect = connect;
  settings.light_selection = selection;
  settings.traversal = phlux::render::Traversal::brute_force;
  return settings;
}

// Points, normals, and the probability of each light (by light, then by point).
struct Choices {
  std::vector<dvec3> points, normals;
  std::vector<std::vector<float>> of_light;
};

Choices choices_at(const SceneProgram& program, std::vector<dvec3> points, std::vector<dvec3> normals) {
  Choices result{std::move(points), std::move(normals), {}};
  std::vector<Float3> at, facing;
  for (const dvec3& point : result.points) at.push_back(to_float(point - program.host().geometry->origin));
  for (const dvec3& normal : result.normals) facing.push_back(to_float(normal));
  for (int light = 0; light < static_cast<int>(program.host().lights.records.size()); ++light) {
    std::vector<float> probability(at.size());
    program.run("light_choices", at.size(), at, facing, light, out(probability));
    result.of_light.push_back(probability);
  }
  return result;
}

Choices choices_at_random(const SceneProgram& program, std::size_t count, double extent, Random& random) {
  std::vector<dvec3> points, normals;
  while (points.size() < count) {
    points.push_back(program.host().geometry->origin + extent * random.point());
    normals.push_back(random.direction());
  }
  return choices_at(program, points, normals);
}

// The part of a probability that comes from the tree: a quarter of the choices is by power.
double by_tree(const SceneProgram& program, const Choices& choices, std::size_t light, std::size_t point) {
  return (choices.of_light[light][point] - 0.25 * program.host().lights.records[light].sample_probability) /
         0.75;
}

} // namespace

TEST_CASE(
    "lights: chosen by contribution, all of them together are certain, and none with power is left out") {
  const auto connect = GENERATE(phlux::render::Connect::light, phlux::render::Connect::mis);
  for (const Variant v : variants) {
    CAPTURE(v, static_cast<int>(connect));
    Random random(73);
    const SceneProgram program(v, "lights.cl", scene_of_many(),
                               choosing_by(phlux::render::LightSelection::contribution, connect));
    const auto& records = program.host().lights.records;
    const Choices choices = choices_at_random(program, thinned(2000), 20, random);
    for (std::size_t i = 0; i < choices.points.size(); ++i) {
      double sum = 0;
      for (std::size_t light = 0; light < records.size(); ++light) {
        const double probability = choices.of_light[light][i];
        CAPTURE(i, light, probability);
        REQUIRE((probability > 0) == (records[light].sample_probability > 0));
        sum += probability;
      }
      REQUIRE(std::abs(sum - 1) < 2e-6);
    }
  }
}

TEST_CASE("lights: of two points that shine, each is chosen in proportion to what arrives") {
  Scene scene = scene_of(Shape::rectangle);
  scene.area_emitters[0].radiance = dvec3(0);
  const dvec3 at[] = {{3, 3, 5}, {-2, 1, 6}};
  const double intensity[] = {60, 20};
  for (std::size_t k = 0; k < 2; ++k) scene.point_lights.push_back({at[k], dvec3(intensity[k])});
  for (const Variant v : variants) {
    CAPTURE(v);
    Random random(74);
    const SceneProgram program(v, "lights.cl", scene,
                               choosing_by(phlux::render::LightSelection::contribution));
    const Choices choices = choices_at_random(program, thinned(2000), 3, random);
    std::size_t lit_by_both = 0;
    for (std::size_t i = 0; i < choices.points.size(); ++i) {
      double arriving[2];
      for (std::size_t k = 0; k < 2; ++k) {
        const dvec3 way = at[k] - choices.points[i];
        const double distance = glm::length(way);
        arriving[k] = intensity[k] * std::max(0.0, glm::dot(choices.normals[i], way)) / std::pow(distance, 3);
      }
      const double sum = arriving[0] + arriving[1];
      CAPTURE(i, arriving[0], arriving[1]);
      for (std::size_t k = 0; k < 2 && sum > 0; ++k)
        REQUIRE(by_tree(program, choices, 1 + k, i) ==
                Approx(arriving[k] / sum).margin(3e-4)); // LEAST_LIKELY_CHILD
      lit_by_both += arriving[0] > 0 && arriving[1] > 0 ? 1 : 0;
    }
    CHECK(lit_by_both > choices.points.size() / 5);
  }
}

TEST_CASE("lights: a light of another side, or that faces away, is hardly ever chosen") {
  const SceneProgram program(
      variants[0], "lights.cl",
      [] {
        Scene scene; // two facing up, one below the other, and one above facing them
        scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
        add_light(scene, Shape::disk, dvec3(0, 0, 0));
        add_light(scene, Shape::triangle, dvec3(0, 0, -3));
        add_light(scene, Shape::rectangle, dvec3(0, 0, 9));
        scene.patches.back().edge_v *= -1.0;
        return scene;
      }(),
      choosing_by(phlux::render::LightSelection::contribution));
  const auto of = [&](const Choices& choices,
                      std::size_t shape) { // lights are in the order of the primitives
    const auto& records = program.host().lights.records;
    for (std::size_t light = 0; light < records.size(); ++light)
      if (records[light].radiance[0] == static_cast<float>(1 + shape))
        return by_tree(program, choices, light, 0);
    return -1.0;
  };
  const Choices up = choices_at(program, {dvec3(0, 0, 3)}, {dvec3(0, 0, 1)});
  CHECK(of(up, 2) > 0.99);
  const Choices down = choices_at(program, {dvec3(0, 0, 3)}, {dvec3(0, 0, -1)});
  CHECK(of(down, 2) < 0.01);
  CHECK(of(down, 0) > of(down, 1));
  const Choices below = choices_at(program, {dvec3(0, 0, -5)}, {dvec3(0, 0, 1)});
  CHECK(of(below, 2) > 0.9); // the others face away
}

TEST_CASE("lights: of many, each is chosen with its probability; densities include it") {
  using phlux::render::LightSelection;
  const auto connect = GENERATE(phlux::render::Connect::light, phlux::render::Connect::mis);
  const Scene scene = scene_of_many();
  const double extent = 4 * 8 + 2 * size;
  for (const LightSelection selection : {LightSelection::power, LightSelection::contribution})
    for (const Variant v : variants) {
      CAPTURE(v, static_cast<int>(selection), static_cast<int>(connect));
      Random random(72);
      const SceneProgram program(v, "lights.cl", scene, choosing_by(selection, connect));
      const auto& records = program.host().lights.records;
      // Many samples at a few places, because the probability of a light depends on the place.
      const Choices choices = choices_at_random(program, 4, 20, random);
      for (std::size_t place = 0; place < choices.points.size(); ++place) {
        const std::size_t count = thinned(10000);
        const auto sampled =
            sample(program, std::vector(count, choices.points[place] - program.host().geometry->origin),
                   choices.normals[place], random);
        std::vector<double> observed(records.size(), 0.0), expected;
        for (std::size_t light = 0; light < records.size(); ++light) {
          const double probability = choices.of_light[light][place];
          if (selection == LightSelection::power)
            REQUIRE(static_cast<float>(probability) == records[light].sample_probability);
          expected.push_back(probability * static_cast<double>(count));
        }
        for (std::size_t i = 0; i < sampled.size(); ++i) {
          const Sampled& s = sampled[i];
          REQUIRE(s.chosen >= 0);
          REQUIRE(static_cast<std::size_t>(s.chosen) < records.size());
          const LightRecord& record = records[static_cast<std::size_t>(s.chosen)];
          observed[static_cast<std::size_t>(s.chosen)] += 1;
          CAPTURE(place, i, record.kind);
          REQUIRE(s.choice ==
                  Approx(choices.of_light[static_cast<std::size_t>(s.chosen)][place]).epsilon(1e-5));
          if (record.kind == LIGHT_POINT) {
            const dvec3 at(record.position[0], record.position[1], record.position[2]);
            const dvec3 way = at - to_double(s.origin);
            REQUIRE(s.radiance.x / s.density == Approx(60 / glm::dot(way, way) / s.choice).epsilon(1e-5));
          } else if (record.kind == LIGHT_DIRECTIONAL) {
            REQUIRE(s.direction.z == 1);
            REQUIRE(s.radiance.x / s.density == Approx(0.5 / s.choice).epsilon(1e-5));
          } else if (s.valid != 0 && s.light == s.chosen) {
            const double squared = static_cast<double>(s.distance) * s.distance;
            const double cosine = s.choice * squared / (record.area * s.density);
            CAPTURE(s.distance, s.density, cosine);
            REQUIRE(std::abs(s.hit_density / s.density - 1) <= density_slack(s.distance, cosine, extent));
          }
        }
        CHECK(chi_square_p(observed, expected) > one_of(2 * 2 * 4 * std::size(variants)));
      }
    }
}
