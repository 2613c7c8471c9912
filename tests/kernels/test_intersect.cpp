// Single intersections compared with float64 for the same float32 inputs.
#include <cmath>
#include <numbers>
#include <vector>

#include "device_test.h"
#include "directions.h"

using namespace device_test;
using glm::dvec3;

namespace {

constexpr double unit = 0x1p-24; // relative error of rounding to float

struct Ray {
  Float3 origin, direction;
};
struct Planar {
  Float3 origin, edge_v, minus_u, normal;
};
struct Crossing {
  float u, v, distance, facing;
  int triangle, parallelogram, ellipse;
};
struct Sphere {
  Float3 center;
  float radius;
};

Planar planar(const dvec3& origin, const dvec3& edge_u, const dvec3& edge_v) {
  const dvec3 cross = glm::cross(edge_u, edge_v);
  const double length = glm::length(cross);
  return {to_float(origin), to_float(edge_v / length), to_float(-edge_u / length), to_float(cross / length)};
}

Ray ray_to(const dvec3& from, const dvec3& to) {
  return {to_float(from), to_float(glm::normalize(to - from))};
}

struct PlanarCases {
  std::vector<Ray> rays;
  std::vector<Planar> planars;
};

// Of sizes from 1e-3 to 1e3 and any proportions; rays inside, outside, at edges and corners, and grazing.
PlanarCases planar_cases(std::size_t count) {
  Random random(51);
  PlanarCases cases;
  for (std::size_t i = 0; i < count; ++i) {
    const double scale = std::exp2(random.uniform(-10, 10));
    const dvec3 origin = scale * random.point(), edge_u = scale * random.direction();
    const dvec3 edge_v = scale * random.uniform(0.01, 1) * random.direction();
    double u = random.uniform(-1.5, 1.5), v = random.uniform(-1.5, 1.5);
    if (i % 5 == 1) u = 0; // edges of the triangle
    if (i % 5 == 2) v = 1 - u;
    if (i % 5 == 3) u = v = 1; // a corner of the parallelogram
    const dvec3 target = origin + u * edge_u + v * edge_v;
    dvec3 away = random.direction();
    if (i % 7 == 0) { // within a thousandth of the plane
      const dvec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
      away = glm::normalize(away - glm::dot(away, normal) * normal * 0.999);
    }
    const double distance = scale * std::exp2(random.uniform(-3, 6));
    const double behind = i % 11 == 0 ? -1 : 1;
    cases.planars.push_back(planar(origin, edge_u, edge_v));
    cases.rays.push_back(ray_to(target + distance * away, target + distance * away * (1 - behind)));
  }
  return cases;
}

} // namespace

TEST_CASE("intersect: planes, and what lies inside triangle, parallelogram and ellipse") {
  const auto cases = planar_cases(thinned(40000));
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Crossing> crossings(cases.rays.size());
    program_of("intersect.cl", v).run("planes", crossings.size(), cases.rays, cases.planars, out(crossings));
    std::size_t inside = 0, undecided = 0;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      CAPTURE(i);
      const Planar& p = cases.planars[i];
      const dvec3 origin = to_double(cases.rays[i].origin), direction = to_double(cases.rays[i].direction);
      const dvec3 from = origin - to_double(p.origin), moment = glm::cross(from, direction);
      const double towards = -glm::dot(to_double(p.normal), direction), sign = towards < 0 ? -1 : 1;
      const double facing = std::abs(towards), reach = glm::length(from);
      const double u = sign * glm::dot(moment, to_double(p.edge_v));
      const double w = sign * glm::dot(moment, to_double(p.minus_u));
      const double distance = sign * glm::dot(to_double(p.normal), from);
      const Crossing& got = crossings[i];
      // Coordinates relative to the origin of the primitive have errors of a few units of the length of the
      // ray.
      const double of_origin = std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)});
      const double slack = 6 * unit * std::max(reach, of_origin * 0.5);
      const double slack_u = slack * glm::length(to_double(p.edge_v)),
                   slack_v = slack * glm::length(to_double(p.minus_u));
      if (facing > 4 * unit) { // its sign is certain
        REQUIRE(std::abs(got.facing - facing) <= 4 * unit);
        REQUIRE(std::abs(got.u - u) <= slack_u);
        REQUIRE(std::abs(got.v - w) <= slack_v);
        REQUIRE(std::abs(got.distance - distance) <= slack);
      }
      // If float64 is further from an edge than the error of float32, both must agree.
      const double margin = 2 * (slack_u + slack_v) + 8 * unit * facing;
      const double triangle = std::min({u, w, facing - u - w});
      const double square = facing - std::max(std::abs(u), std::abs(w));
      const double circle = facing - std::hypot(u, w);
      if (std::abs(triangle) > margin) REQUIRE(got.triangle == (triangle > 0));
      if (std::abs(square) > margin) REQUIRE(got.parallelogram == (square > 0));
      if (std::abs(circle) > 2 * margin) REQUIRE(got.ellipse == (circle > 0));
      undecided += std::abs(triangle) <= margin;
      inside += triangle > margin;
    }
    CHECK(inside > crossings.size() / 80);
    CHECK(undecided < crossings.size() / 2); // the rays aimed at edges
  }
}

TEST_CASE("intersect: crosses_before compares distances, and behind the origin is never before") {
  const auto cases = planar_cases(thinned(10000));
  Random random(52);
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Crossing> crossings(cases.rays.size());
    const auto program = program_of("intersect.cl", v);
    program.run("planes", crossings.size(), cases.rays, cases.planars, out(crossings));
    std::vector<float> limits(crossings.size());
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const double distance = crossings[i].distance / crossings[i].facing;
      limits[i] = static_cast<float>(std::abs(distance) * (random.word() % 2 == 0 ? 0.999 : 1.001));
    }
    std::vector<int> before(limits.size());
    program.run("before", limits.size(), cases.rays, cases.planars, limits, out(before));
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const double distance = static_cast<double>(crossings[i].distance) / crossings[i].facing;
      REQUIRE(before[i] == (distance > 0 && distance < limits[i]));
    }
  }
}

TEST_CASE("intersect: spheres from outside and inside, grazing, huge and tiny") {
  Random random(53);
  std::vector<Ray> rays;
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < thinned(60000); ++i) {
    const double radius = i % 4 == 0 ? 1e4 : i % 4 == 1 ? 1e-4 : std::exp2(random.uniform(-6, 6));
    const dvec3 center = radius * random.uniform(0, 3) * random.point();
    const dvec3 axis = random.direction();
    dvec3 across = random.direction();
    across = glm::normalize(across - glm::dot(across, axis) * axis);
    // The ray starts `away` radii back and passes the centre at a distance of `miss` radii; some origins are
    // inside.
    const double miss = i % 3 == 0 ? 1 + random.uniform(-1e-4, 1e-4) : random.uniform(0, 1.3);
    const double away = i % 5 == 0 ? random.uniform(-1, 1) : std::exp2(random.uniform(0, 8));
    spheres.push_back({to_float(center), static_cast<float>(radius)});
    rays.push_back({to_float(center + radius * (miss * across - away * axis)), to_float(axis)});
  }
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<float> distances(rays.size());
    program_of("intersect.cl", v).run("spheres", rays.size(), rays, spheres, out(distances));
    std::size_t hits = 0, misses = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      CAPTURE(i);
      const double radius = spheres[i].radius;
      const dvec3 from = to_double(rays[i].origin) - to_double(spheres[i].center);
      const dvec3 direction = glm::normalize(to_double(rays[i].direction));
      const double b = -glm::dot(from, direction);
      const dvec3 closest = from + b * direction;
      const double discriminant = radius * radius - glm::dot(closest, closest);
      // Errors in units of the inputs: that of the point of closest approach is a few units of |from|.
      const double error =
          8 * unit *
          (glm::length(from) * (glm::length(closest) + glm::length(from) * unit) + radius * radius);
      if (discriminant < -error) {
        REQUIRE(distances[i] == 0);
        ++misses;
      }
      if (discriminant <= 2 * error) continue;
      const double root = std::sqrt(discriminant), slack = error / root + 8 * unit * glm::length(from);
      const double near = b - root, far = b + root;
      if (std::abs(near) <= slack || std::abs(far) <= slack) continue; // starts on the surface: another test
      const double right = near > 0 ? near : far > 0 ? far : 0;
      REQUIRE(std::abs(distances[i] - right) <= slack);
      ++hits;
    }
    CHECK(hits > rays.size() / 2);
    CHECK(misses > rays.size() / 10);
  }
}
