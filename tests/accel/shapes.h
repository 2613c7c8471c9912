// Scenes of shapes with distinct materials, by which tests identify them.
#pragma once

#include <random>

#include "accel/primitive.h"

namespace accel_test {

using namespace phlux;

/// A scene, and the reference of each primitive by its material.
struct Shapes {
  scene::Scene scene;
  std::vector<accel::Reference> references;

  void add_triangle(const scene::Vec3& a, const scene::Vec3& b, const scene::Vec3& c) {
    references.push_back({accel::Reference::Kind::mesh, static_cast<std::uint32_t>(scene.meshes.size()), 0});
    scene.meshes.push_back({{a, b, c}, {}, {{0, 1, 2}}, surface()});
  }
  void add_patch(scene::Patch::Region region, const scene::Vec3& origin, const scene::Vec3& edge_u,
                 const scene::Vec3& edge_v) {
    references.push_back(
        {accel::Reference::Kind::patch, static_cast<std::uint32_t>(scene.patches.size()), 0});
    scene.patches.push_back({region, origin, edge_u, edge_v, surface()});
  }
  void add_sphere(const scene::Vec3& center, double radius) {
    references.push_back(
        {accel::Reference::Kind::sphere, static_cast<std::uint32_t>(scene.spheres.size()), 0});
    scene.spheres.push_back({center, radius, false, surface()});
  }

private:
  [[nodiscard]] scene::Surface surface() const { return {static_cast<int>(references.size()) - 1, -1}; }
};

/// Small shapes in a cube of side 20.
inline Shapes random_shapes(int triangles, int patches, int spheres) {
  Shapes shapes;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10), size(-0.5, 0.5);
  const auto vector = [&](auto& of) { return scene::Vec3(of(random), of(random), of(random)); };
  for (int i = 0; i < triangles; ++i) {
    const scene::Vec3 at = vector(place);
    shapes.add_triangle(at, at + vector(size), at + vector(size));
  }
  for (int i = 0; i < patches; ++i)
    shapes.add_patch(i % 2 == 0 ? scene::Patch::Region::ellipse : scene::Patch::Region::parallelogram,
                     vector(place), vector(size), vector(size));
  for (int i = 0; i < spheres; ++i) shapes.add_sphere(vector(place), 0.1 + std::abs(size(random)));
  return shapes;
}

} // namespace accel_test
