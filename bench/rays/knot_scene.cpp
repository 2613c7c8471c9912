#include "bench/rays/knot_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lobes/models.h"

namespace phlux::bench {
namespace {

using scene::Vec3;
constexpr double turn = 2 * std::numbers::pi;

// A (2, 3) torus knot.
Vec3 knot(double t) {
  const double radius = 2 + std::cos(3 * t);
  return {radius * std::cos(2 * t), radius * std::sin(2 * t), std::sin(3 * t)};
}

Vec3 surface(double t, double around) {
  const Vec3 center = knot(t), along = glm::normalize(knot(t + 1e-4) - center);
  const Vec3 side = glm::normalize(glm::cross(along, Vec3(0, 0, 1))), up = glm::cross(side, along);
  const double bump = 0.45 * (1 + 0.08 * std::sin(9 * around) * std::sin(60 * t));
  return center + bump * (std::cos(around) * side + std::sin(around) * up);
}

void add_knot(scene::Mesh& mesh, std::uint64_t triangles) {
  const double even = std::sqrt(static_cast<double>(triangles) * 1.5); // for quads about as long as wide
  const auto rings = static_cast<std::uint32_t>(std::min(even, static_cast<double>(triangles / 6)));
  const auto sides = static_cast<std::uint32_t>(triangles / 2 / rings);
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sides; ++j)
      mesh.positions.push_back(surface(turn * i / rings, turn * j / sides));
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t next_i = (i + 1) % rings, next_j = (j + 1) % sides;
      const std::uint32_t a = i * sides + j, b = next_i * sides + j, c = next_i * sides + next_j,
                          d = i * sides + next_j;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
}

void add_room(scene::Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back((corner & 1) != 0 ? 5 : -5, (corner & 2) != 0 ? 5 : -5,
                                (corner & 4) != 0 ? 5 : -5);
  constexpr std::uint32_t walls[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                         {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& w : walls) {
    mesh.triangles.push_back({first + w[0], first + w[1], first + w[2]});
    mesh.triangles.push_back({first + w[0], first + w[2], first + w[3]});
  }
}

} // namespace

scene::Scene knot_scene(std::uint64_t triangles) {
  scene::Scene scene;
  scene.materials.push_back(lobes::diffuse(scene::Rgb(0.5)));
  scene::Mesh mesh;
  add_knot(mesh, std::max<std::uint64_t>(triangles, 36) - 12);
  add_room(mesh);
  scene.meshes.push_back(std::move(mesh));
  scene.camera.position = {0, 0, 4.8};
  scene.camera.forward = {0, 0, -1};
  scene.camera.left = {-1, 0, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.width = scene.camera.height = 512;
  return scene;
}

} // namespace phlux::bench
