// Tables of a scene's primitives for ray intersection: planar primitives and spheres in blocks, and an
// optional bounding volume hierarchy.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::accel {

/// Largest depth of a leaf; kernels/scene/traverse_bvh.cl sizes its stack by it.
inline constexpr int max_depth_wide = 24, max_depth_binary = 64;

/// A primitive that emits.
struct EmittingPrimitive {
  double area;           ///< m^2
  scene::Vec3 low, high; ///< corners of its bounding box, relative to the geometry's origin
  scene::Vec3 normal;    ///< unit, on the emitting side; (0, 0, 0) for a sphere
};

struct Geometry {
  int block = 1;              ///< primitives per block
  std::vector<float> planars; ///< PLANAR_FLOATS values per planar primitive, in blocks
  std::vector<float> spheres; ///< SPHERE_FLOATS values per sphere, in blocks
  bool in_double = false;     ///< the tables of double are used, and those of float are empty
  std::vector<double> double_planars, double_spheres;
  std::vector<PrimitiveRecord> primitives; ///< planar ones (with padding), then spheres; `light` is still -1
  std::vector<int> emitters;               ///< per primitive: its scene::AreaEmitter, -1 for none
  std::vector<EmittingPrimitive> emitting; ///< in the order of `primitives`
  std::vector<int> corners; ///< 3 indices into vertex_normals per planar primitive; empty: no vertex normals
  std::vector<float> vertex_normals; ///< 3 per vertex
  std::vector<float> uv_maps;        ///< UV_FLOATS per primitive; empty: no material needs them
  std::vector<float> nodes;          ///< the hierarchy, see NodeValues; empty: brute force
  int root = 0;                      ///< a child reference as in NodeValues
  int triangle_end = 0, parallelogram_end = 0, ellipse_end = 0; ///< ranges of planar primitives (brute force)
  int first_sphere = 0, sphere_count = 0; ///< primitive index of the first sphere; spheres, with padding
  bool has_triangles = false, has_parallelograms = false, has_ellipses = false;
  std::uint64_t primitive_count = 0; ///< without padding
  scene::Vec3 origin{0.0};           ///< world position of the tables' origin: the centre of the scene
  double radius = 0.0;               ///< of a bounding sphere about the origin
};

// Both leave out degenerate primitives (has_area in accel/primitive.h), possibly all of them.

/// Tables for testing every primitive in turn, ordered as PlanarRegions, in blocks of one.
[[nodiscard]] Geometry brute_force(const scene::Scene& scene, bool in_double = false);

/// Tables with a hierarchy of max(2, lanes) children a node and blocks of `lanes` primitives.
[[nodiscard]] Geometry hierarchy(const scene::Scene& scene, int lanes, bool in_double = false);

/// The number of primitives of the scene's shapes.
[[nodiscard]] std::uint64_t count_primitives(const scene::Scene& scene);

} // namespace phlux::accel
