// Emission: origin, direction, weight and density.
#include <cmath>
#include <functional>
#include <numbers>
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

struct Emitted {
  Float3 origin, direction, radiance, position, normal;
  float density, cosine, found;
  int light, surface, sky;
};

// A floor without emission gives the scene a size, which lights without a surface need.
Scene floor_alone() {
  Scene scene;
  scene.materials.push_back(phlux::lobes::diffuse(phlux::scene::Rgb(0.5)));
  scene.patches.push_back({Patch::Region::parallelogram, dvec3(1, 2, -3), {4, 0, 0}, {0, 3, 0}, {}});
  return scene;
}

const dvec3 center(0.5, -0.3, 1.2), edge_u(0.6, 0.1, 0), edge_v(-0.2, 0.7, 0.3);
const dvec3 radiance(3, 2, 1);
constexpr double radius = 0.8, beam = 0.3, cutoff = 0.7;
const dvec3 axis = glm::normalize(dvec3(1, -2, 0.5));
const std::vector<dvec3> corners = {{0, 0, 0}, {1, 0, 0.1}, {0, 1.5, 0}, {0.2, 0.1, 2}};

void add_surface_light(Scene& scene, const std::function<void(const phlux::scene::Surface&)>& add) {
  scene.area_emitters.push_back({radiance});
  add({0, static_cast<int>(scene.area_emitters.size()) - 1});
}

using Maker = void (*)(Scene&);
struct Kind {
  const char* name;
  Maker add;
  double power; ///< of its red channel, in closed form
};

double triangle_area(const std::vector<dvec3>& points, int a, int b, int c) {
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  return glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) / 2;
}

// Integral of a falloff that is linear in the angle: the mean of the solid angles within each angle from beam
// to cutoff.
double spot_solid_angle() {
  return 2 * pi * (1 - (std::sin(cutoff) - std::sin(beam)) / (cutoff - beam));
}

double disk_across(const Scene& scene) {
  const auto host = phlux::render::prepare(scene, {}, 1);
  return pi * host.geometry->radius * host.geometry->radius;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {"rectangle",
       [](Scene& scene) {
         add_surface_light(scene, [&](const auto& surface) {
           scene.patches.push_back({Patch::Region::parallelogram, center, edge_u, edge_v, surface});
         });
       },
       pi * 3 * 4 * glm::length(glm::cross(edge_u, edge_v))},
      {"disk",
       [](Scene& scene) {
         add_surface_light(scene, [&](const auto& surface) {
           scene.patches.push_back({Patch::Region::ellipse, center, edge_u, edge_v, surface});
         });
       },
       pi * 3 * pi * glm::length(glm::cross(edge_u, edge_v))},
      {"mesh",
       [](Scene& scene) {
         add_surface_light(scene, [&](const auto& surface) {
           scene.meshes.push_back({corners, {}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}}, surface});
         });
       },
       pi * 3 *
           (triangle_area(corners, 0, 1, 2) + triangle_area(corners, 0, 3, 1) +
            triangle_area(corners, 1, 3, 2))},
      {"sphere",
       [](Scene& scene) {
         add_surface_light(scene, [&](const auto& surface) {
           scene.spheres.push_back({center, radius, false, surface});
         });
       },
       pi * 3 * 4 * pi * radius * radius},
      {"inside of a sphere",
       [](Scene& scene) {
         add_surface_light(scene, [&](const auto& surface) {
           scene.spheres.push_back({center, radius, true, surface});
         });
       },
       pi * 3 * 4 * pi * radius * radius},
      {"point",
       [](Scene& scene) {
         scene.point_lights.push_back({center, radiance});
       },
       4 * pi * 3},
      {"spot",
       [](Scene& scene) {
         scene.spot_lights.push_back({center, axis, radiance, cutoff, beam});
       },
       3 * spot_solid_angle()},
      {"directional",
       [](Scene& scene) {
         scene.directional_lights.push_back({axis, radiance});
       },
       3 * disk_across(floor_alone())},
      {"constant", [](Scene& scene) { scene.constant_radiance = radiance; },
       4 * pi * 3 * disk_across(floor_alone())},
  };
  return list;
}

std::vector<Emitted> emit(const SceneProgram& program, std::size_t count, Random& random) {
  std::vector<std::uint32_t> path(count);
  std::vector<Float3> lit(count);
  const dvec3 origin = program.host().geometry->origin;
  for (std::size_t i = 0; i < count; ++i) {
    path[i] = static_cast<std::uint32_t>(i);
    lit[i] = to_float(center + dvec3(0.1, -0.2, 2.5) - origin);
  }
  std::vector<Emitted> emitted(count);
  const cl_uint2 seed = {{random.word(), 0}};
  program.run("sample_emission", count, seed, path, lit, out(emitted));
  return emitted;
}

// Tests that numbers are uniform in (0, 1).
void check_uniform(const std::vector<double>& numbers, std::size_t questions) {
  constexpr std::size_t cells = 32;
  std::vector<double> observed(cells, 0.0);
  for (const double x : numbers) {
    REQUIRE((x >= -1e-5 && x <= 1 + 1e-5));
    observed[std::min(static_cast<std::size_t>(std::max(x, 0.0) * cells), cells - 1)] += 1;
  }
  CHECK(chi_square_p(observed, std::vector<double>(cells, static_cast<double>(numbers.size()) / cells)) >
        one_of(questions));
}

double turns(double x, double y) {
  return std::atan2(y, x) / (2 * pi) + 0.5;
}

// Two unit vectors perpendicular to an axis and to each other.
std::pair<dvec3, dvec3> across(const dvec3& z) {
  const dvec3 x = glm::normalize(glm::cross(std::abs(z.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), z));
  return {x, glm::cross(z, x)};
}

using Pair = std::pair<double, double>;

// Origin of a path on its light as two numbers that must be uniform in (0, 1).
Pair place_of(const std::string& kind, const Emitted& e, const dvec3& origin, double disk_radius) {
  const dvec3 point = to_double(e.position) + origin - center;
  if (kind == "rectangle" || kind == "disk") {
    const double uu = glm::dot(edge_u, edge_u), uv = glm::dot(edge_u, edge_v), vv = glm::dot(edge_v, edge_v);
    const double pu = glm::dot(point, edge_u), pv = glm::dot(point, edge_v), det = uu * vv - uv * uv;
    const double u = (vv * pu - uv * pv) / det, v = (uu * pv - uv * pu) / det;
    return kind == "disk" ? Pair{u * u + v * v, turns(u, v)} : Pair{(u + 1) / 2, (v + 1) / 2};
  }
  if (kind == "sphere" || kind == "inside of a sphere") {
    const dvec3 unit = point / radius;
    return {(unit.z + 1) / 2, turns(unit.x, unit.y)};
  }
  const dvec3 direction = to_double(e.direction), from = to_double(e.origin);
  const auto [x, y] = across(direction);
  const double a = glm::dot(from, x) / disk_radius, b = glm::dot(from, y) / disk_radius;
  return {a * a + b * b, turns(a, b)};
}

// Direction of a path as two numbers that must be uniform in (0, 1).
Pair direction_of(const std::string& kind, const Emitted& e) {
  const dvec3 direction = to_double(e.direction);
  if (kind == "point" || kind == "constant") return {(direction.z + 1) / 2, turns(direction.x, direction.y)};
  const dvec3 z = kind == "spot" ? axis : to_double(e.normal);
  const double cosine = glm::dot(direction, z);
  const auto [x, y] = across(z);
  const double about = turns(glm::dot(direction, x), glm::dot(direction, y));
  return {kind == "spot" ? (1 - cosine) / (1 - std::cos(cutoff)) : cosine * cosine, about};
}

bool has_place(const std::string& kind) {
  return kind != "point" && kind != "spot" && kind != "mesh";
}

void check_pairs(const std::vector<Pair>& pairs, std::size_t questions) {
  std::vector<double> first, second;
  for (const auto& [a, b] : pairs) {
    first.push_back(a);
    second.push_back(b);
  }
  check_uniform(first, questions);
  check_uniform(second, questions);
}

void check_kind(const Kind& kind, const SceneProgram& program, const std::vector<Emitted>& emitted) {
  const std::string name = kind.name;
  const dvec3 origin = program.host().geometry->origin;
  const double disk_radius = program.host().geometry->radius;
  const LightRecord& record = program.host().lights.records.at(0);
  const std::size_t questions = 5 * kinds().size() * std::size(variants);
  std::vector<Pair> places, directions;
  double sum = 0, squares = 0, found = 0, found_squares = 0;
  for (const Emitted& e : emitted) {
    REQUIRE(std::abs(glm::length(to_double(e.direction)) - 1) < 4e-7);
    const double power = e.radiance.x / e.density;
    sum += power;
    squares += power * power;
    if (has_place(name)) places.push_back(place_of(name, e, origin, disk_radius));
    if (name != "directional") directions.push_back(direction_of(name, e));
    REQUIRE(e.surface == (record.kind == LIGHT_PLANAR || record.kind == LIGHT_SPHERE));
    REQUIRE(e.sky == (record.kind == LIGHT_SKY));
    // The density of the point alone, if its direction follows the cosine.
    const double relative = e.surface != 0 ? e.found / (e.density * pi) : 0;
    found += relative;
    found_squares += relative * relative;
    if (e.surface != 0) {
      REQUIRE(e.cosine > 0);
      REQUIRE(glm::length(to_double(e.origin) - to_double(e.position)) < 1e-4);
      if (name != "sphere" && e.found > 0) REQUIRE(relative == Approx(1).epsilon(2e-5));
    } else if (name == "point" || name == "spot") {
      REQUIRE(glm::length(to_double(e.origin) + origin - center) < 1e-5);
    } else {
      // Outside of the scene, and towards it.
      REQUIRE(glm::length(to_double(e.origin)) >= disk_radius * (1 - 1e-5));
      REQUIRE(glm::dot(to_double(e.origin), to_double(e.direction)) < 0);
    }
    if (name == "directional") REQUIRE(glm::length(to_double(e.direction) - axis) < 1e-6);
  }
  const double n = static_cast<double>(emitted.size()), mean = sum / n;
  const double error = std::sqrt(std::max(0.0, squares / n - mean * mean) / n);
  CAPTURE(mean, error, kind.power);
  CHECK(mean_p(mean, error, kind.power) > one_of(questions));
  if (!places.empty()) check_pairs(places, questions);
  if (!directions.empty()) check_pairs(directions, questions);
  if (name == "sphere") {
    // The density of the cone integrates to 1 over the visible part of the sphere.
    const double expected = found / n, spread = std::sqrt((found_squares / n - expected * expected) / n);
    CHECK(mean_p(expected, spread, 1) > one_of(questions));
  }
}

} // namespace

TEST_CASE("emission: each kind of light sends its power, from and to where it should") {
  for (const Variant v : variants)
    for (const Kind& kind : kinds()) {
      CAPTURE(v, kind.name);
      Random random(101);
      Scene scene = floor_alone();
      kind.add(scene);
      // The disk of the floor was computed without the light: lights without a surface do not change it.
      const SceneProgram program(v, "emission.cl", scene);
      check_kind(kind, program, emit(program, thinned(20000), random));
    }
}

TEST_CASE("emission: of many lights, each sends its power, chosen with its probability") {
  Scene scene = floor_alone();
  double power = 0;
  for (const Kind& kind : kinds()) kind.add(scene);
  scene.point_lights.push_back({center, dvec3(0)}); // without power: never chosen
  const double disk = disk_across(scene), disk_before = disk_across(floor_alone());
  for (const Kind& kind : kinds()) {
    const std::string name = kind.name;
    power += name == "directional" || name == "constant" ? kind.power * disk / disk_before : kind.power;
  }
  for (const Variant v : variants) {
    CAPTURE(v);
    Random random(102);
    const SceneProgram program(v, "emission.cl", scene);
    const auto emitted = emit(program, thinned(100000), random);
    const auto& records = program.host().lights.records;
    std::vector<double> observed(records.size(), 0.0), expected;
    for (const LightRecord& record : records)
      expected.push_back(record.probability * static_cast<double>(emitted.size()));
    double sum = 0, squares = 0;
    for (const Emitted& e : emitted) {
      const auto light = static_cast<std::size_t>(e.light);
      REQUIRE(light < records.size());
      observed[light] += 1;
      REQUIRE(e.density == records[light].emission_density);
      REQUIRE(e.surface == (records[light].kind <= LIGHT_SPHERE));
      const double one = e.radiance.x / e.density;
      sum += one;
      squares += one * one;
    }
    const double n = static_cast<double>(emitted.size()), mean = sum / n;
    CAPTURE(mean, power);
    CHECK(mean_p(mean, std::sqrt((squares / n - mean * mean) / n), power) > one_of(2 * std::size(variants)));
    CHECK(chi_square_p(observed, expected) > one_of(2 * std::size(variants)));
  }
}
