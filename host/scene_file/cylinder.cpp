#include "scene_file/cylinder.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace phlux::scene_file {

namespace {

constexpr std::uint32_t facets = 256;
/// Angle of half a facet.
constexpr double half_angle = std::numbers::pi / facets;

} // namespace

MeshPart cylinder(const scene::Vec3& p0, const scene::Vec3& p1, double radius) {
  const scene::Vec3 axis = glm::normalize(p1 - p0);
  const scene::Vec3 other = std::abs(axis.x) < 0.5 ? scene::Vec3(1, 0, 0) : scene::Vec3(0, 1, 0);
  const scene::Vec3 u = glm::normalize(glm::cross(other, axis)), v = glm::cross(axis, u);
  // The polygon through these points is as long as the circle: 2 facets r' sin(half_angle) = 2 pi r.
  const double corner_radius = radius * half_angle / std::sin(half_angle);
  MeshPart part;
  for (std::uint32_t i = 0; i < facets; ++i) {
    const scene::Vec3 normal = std::cos(2.0 * half_angle * i) * u + std::sin(2.0 * half_angle * i) * v;
    for (const scene::Vec3& end : {p0, p1}) {
      part.mesh.positions.push_back(end + corner_radius * normal);
      part.mesh.normals.emplace_back(normal);
    }
    const std::uint32_t low = 2 * i, next_low = 2 * ((i + 1) % facets);
    part.mesh.triangles.push_back({low, next_low, next_low + 1});
    part.mesh.triangles.push_back({low, next_low + 1, low + 1});
  }
  return part;
}

} // namespace phlux::scene_file
