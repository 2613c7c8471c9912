// Vectors for kernels, and their angles.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace device_test {

struct Float3 {
  float x, y, z;
};

inline Float3 to_float(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// The nearest float32 vector, which is what the device is given.
inline glm::dvec3 as_float(const glm::dvec3& v) {
  return glm::vec3(v);
}
inline glm::dvec3 to_double(const Float3& v) {
  return {v.x, v.y, v.z};
}

/// The direction at this angle to z and this longitude from x; both in radians.
inline glm::dvec3 polar(double angle, double longitude) {
  return {std::sin(angle) * std::cos(longitude), std::sin(angle) * std::sin(longitude), std::cos(angle)};
}

/// Random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
  double uniform() { return (word() + 0.5) / 4294967296.0; } ///< in (0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  glm::dvec3 point() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; } ///< of a cube
  glm::dvec3 direction() {                                                        ///< uniform over the sphere
    const double z = uniform(-1, 1);
    return polar(std::acos(z), 2 * std::numbers::pi * uniform());
  }
  glm::dvec3 direction_above() { ///< uniform over the hemisphere about z
    const glm::dvec3 d = direction();
    return {d.x, d.y, std::abs(d.z)};
  }

private:
  std::mt19937 engine_;
};

} // namespace device_test
