#include "accel/geometry.h"

#include <algorithm>
#include <cmath>

#include "accel/primitive.h"

namespace phlux::accel {

std::uint64_t count_primitives(const scene::Scene& scene) {
  std::uint64_t count = scene.patches.size() + scene.spheres.size();
  for (const scene::Mesh& mesh : scene.meshes) count += mesh.triangles.size();
  return count;
}

Geometry brute_force(const scene::Scene& scene, bool in_double) {
  Geometry geometry;
  geometry.in_double = in_double;
  geometry.origin = middle(scene);
  TableWriter writer(scene, geometry);
  Box all = {};
  const auto include = [&](Reference reference) {
    const Box box = bounds(scene, geometry.origin, reference);
    for (std::size_t axis = 0; axis < 3; ++axis)
      all.high[axis] = std::max({all.high[axis], std::abs(box.low[axis]), std::abs(box.high[axis])});
  };
  const auto add_planar = [&](Reference reference) {
    if (!has_area(scene, geometry.origin, reference, in_double)) return;
    writer.add_planar(reference);
    include(reference);
  };
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
    for (std::uint32_t i = 0; i < scene.meshes[mesh].triangles.size(); ++i)
      add_planar({Reference::Kind::mesh, mesh, i});
  geometry.triangle_end = writer.finish_planar_block();
  for (const auto region : {scene::Patch::Region::parallelogram, scene::Patch::Region::ellipse}) {
    for (std::uint32_t i = 0; i < scene.patches.size(); ++i)
      if (scene.patches[i].region == region) add_planar({Reference::Kind::patch, i, 0});
    (region == scene::Patch::Region::parallelogram ? geometry.parallelogram_end : geometry.ellipse_end) =
        writer.finish_planar_block();
  }
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    const Reference sphere{Reference::Kind::sphere, i, 0};
    writer.add_sphere(sphere);
    include(sphere);
  }
  writer.finish();
  geometry.radius = std::hypot(all.high[0], all.high[1], all.high[2]);
  return geometry;
}

} // namespace phlux::accel
