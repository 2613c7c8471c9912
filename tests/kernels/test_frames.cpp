#include <algorithm>
#include <cmath>
#include <vector>

#include "device_test.h"
#include "directions.h"

using namespace device_test;

namespace {

constexpr double ulp = 0x1p-24; // of components in [0.5, 1)

struct Frame {
  Float3 x, y, z;
};

// Directions everywhere, at the poles, and next to them: older constructions fail at z = -1 + eps.
std::vector<Float3> unit_vectors() {
  Random random(21);
  std::vector<Float3> list{{0, 0, 1}, {0, 0, -1}, {1, 0, 0},     {-1, 0, 0},
                           {0, 1, 0}, {0, -1, 0}, {1, 0, -0.0f}, {0, 1, -0.0f}};
  for (int exponent = -24; exponent <= -2; ++exponent)
    for (const double sign : {-1.0, 1.0}) {
      const double z = sign * (1 - std::exp2(exponent)), radius = std::sqrt(1 - z * z);
      for (int turn = 0; turn < 16; ++turn) {
        const double phi = 0.1 + turn * std::numbers::pi / 8;
        list.push_back(to_float({radius * std::cos(phi), radius * std::sin(phi), z}));
      }
    }
  while (list.size() < 10000) list.push_back(to_float(random.direction()));
  return list;
}

// Deviation from an orthonormal right-handed frame.
double fault_of(const Frame& frame) {
  const auto x = to_double(frame.x), y = to_double(frame.y), z = to_double(frame.z);
  const auto handed = glm::cross(x, y) - z;
  return std::max({std::abs(glm::dot(x, x) - 1) / 2, std::abs(glm::dot(y, y) - 1) / 2,
                   std::abs(glm::dot(x, y)), std::abs(glm::dot(x, z)), std::abs(glm::dot(y, z)),
                   glm::length(handed)});
}

} // namespace

TEST_CASE("frames: frame_about is orthonormal to 4 ulp, poles and their neighbours included") {
  const auto z = unit_vectors();
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Frame> frames(z.size());
    program_of("frames.cl", v).run("about", z.size(), z, out(frames));
    double worst = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      CAPTURE(z[i].x, z[i].y, z[i].z);
      REQUIRE(to_double(frames[i].z) == to_double(z[i]));
      const double fault = fault_of(frames[i]) / ulp;
      worst = std::max(worst, fault);
      REQUIRE(fault <= 4.0);
    }
    CAPTURE(worst);
    CHECK(worst > 0.0);
  }
}

TEST_CASE("frames: frame_along has its x along the tangent; a useless tangent does no harm") {
  Random random(22);
  const auto z = unit_vectors();
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Float3> tangents;
    for (std::size_t i = 0; i < z.size(); ++i) {
      const glm::dvec3 normal = to_double(z[i]), any = random.direction();
      const double scale = std::exp2(random.uniform(-20, 20)); // neither unit ...
      switch (i % 4) {
      case 0:
        tangents.push_back({0, 0, 0});
        break;
      case 1:
        tangents.push_back(to_float(scale * normal));
        break;
      case 2: // ... nor perpendicular
        tangents.push_back(to_float(scale * any));
        break;
      default:
        tangents.push_back(to_float(scale * (normal + 1e-3 * any)));
      }
    }
    std::vector<Frame> frames(z.size());
    program_of("frames.cl", v).run("along", z.size(), z, tangents, out(frames));
    for (std::size_t i = 0; i < z.size(); ++i) {
      CAPTURE(i, z[i].x, z[i].y, z[i].z);
      const auto normal = to_double(z[i]), tangent = to_double(tangents[i]);
      const double length = glm::length(tangent);
      const double sine = length > 0 ? glm::length(glm::cross(normal, tangent)) / length : 0;
      // Removing the component along the normal from a tangent multiplies rounding errors by 1 / sine of
      // their angle.
      const double bound = sine > 1e-4 ? 4 + 4 / sine : 4;
      REQUIRE(fault_of(frames[i]) <= bound * ulp);
      if (sine > 1e-2) {
        REQUIRE(glm::dot(to_double(frames[i].x), tangent) > 0);
        REQUIRE(std::abs(glm::dot(to_double(frames[i].y), tangent)) <= 8 * ulp * length);
      }
    }
  }
}

TEST_CASE("frames: into a frame and back") {
  Random random(23);
  const auto z = unit_vectors();
  std::vector<Float3> given(z.size());
  for (auto& each : given) each = to_float(random.point());
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Float3> inside(z.size()), back(z.size());
    program_of("frames.cl", v).run("there_and_back", z.size(), z, given, out(inside), out(back));
    for (std::size_t i = 0; i < z.size(); ++i) {
      const auto vector = to_double(given[i]);
      REQUIRE(std::abs(to_double(inside[i]).z - glm::dot(to_double(z[i]), vector)) <= 4 * ulp);
      REQUIRE(glm::length(to_double(back[i]) - vector) <= 16 * ulp);
    }
  }
}
