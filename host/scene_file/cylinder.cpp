#include "scene_file/cylinder.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "scene_file/coordinate_system.h"

namespace phlux::scene_file {

namespace {

constexpr std::uint32_t facets = facets_of_cylinder;
/// Angle of half a facet.
constexpr double half_angle = std::numbers::pi / facets;

} // namespace

MeshPart cylinder(const scene::Vec3& p0, const scene::Vec3& p1, double radius, int major_version) {
  const scene::Vec3 axis = glm::normalize(p1 - p0);
  const scene::Vec3 u = first_tangent(axis, major_version), v = glm::cross(axis, u);
  // The polygon through these points is as long as the circle: 2 facets r' sin(half_angle) = 2 pi r.
  const double corner_radius = radius * half_angle / std::sin(half_angle);
  MeshPart part;
  for (std::uint32_t i = 0; i <= facets; ++i) { // the last column is the first with u = 1
    const double angle = 2.0 * half_angle * (i % facets);
    const scene::Vec3 normal = std::cos(angle) * u + std::sin(angle) * v;
    for (const int end : {0, 1}) {
      part.mesh.positions.push_back((end == 0 ? p0 : p1) + corner_radius * normal);
      part.mesh.normals.emplace_back(normal);
      part.mesh.texture_coordinates.emplace_back(static_cast<double>(i) / facets, end);
    }
  }
  for (std::uint32_t low = 0; low < 2 * facets; low += 2) {
    part.mesh.triangles.push_back({low, low + 2, low + 3});
    part.mesh.triangles.push_back({low, low + 3, low + 1});
  }
  return part;
}

} // namespace phlux::scene_file
