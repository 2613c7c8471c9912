// A scene's shapes as the tables that kernels intersect: flat primitives and spheres in blocks, and a
// hierarchy over them where one is wanted.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::accel {

/// Deepest leaf of a hierarchy; kernels/scene/traverse_bvh.cl sizes its stack by them.
inline constexpr int max_depth_wide = 24, max_depth_binary = 64;

/// A primitive that emits.
struct EmittingPrimitive {
  double area;           ///< m^2
  scene::Vec3 low, high; ///< corners of a box that holds it, about the geometry's origin
  scene::Vec3 normal;    ///< unit, on the side that emits; (0, 0, 0): of a sphere, any
};

struct Geometry {
  int block = 1;              ///< primitives per block
  std::vector<float> planars; ///< PLANAR_FLOATS values per flat primitive, in blocks
  std::vector<float> spheres; ///< SPHERE_FLOATS values per sphere, in blocks
  bool in_double = false;     ///< those two are empty and these hold the same, not rounded to float
  std::vector<double> double_planars, double_spheres;
  std::vector<PrimitiveRecord>
      primitives;            ///< flat ones (fillers included), then spheres; `light` is still -1
  std::vector<int> emitters; ///< per primitive: its scene::AreaEmitter, -1 for none
  std::vector<EmittingPrimitive> emitting; ///< those that do, in the order of `primitives`
  std::vector<int> corners;          ///< 3 per flat primitive, indices into vertex_normals; empty: all flat
  std::vector<float> vertex_normals; ///< 3 per vertex
  std::vector<float> nodes;          ///< the hierarchy, see NodeValues; empty: brute force
  int root = 0;                      ///< a child reference as in NodeValues
  int triangle_end = 0, parallelogram_end = 0, ellipse_end = 0; ///< ranges of flat primitives (brute force)
  int first_sphere = 0, sphere_count = 0; ///< primitive index of the first sphere; spheres, fillers included
  bool has_triangles = false, has_parallelograms = false, has_ellipses = false;
  std::uint64_t primitive_count = 0; ///< without fillers
  scene::Vec3 origin{0.0};           ///< world position of the tables' origin: the middle of the scene
  double radius = 0.0;               ///< of a sphere about the origin that holds every primitive
};

// Primitives without an area that single precision can tell from 0 are left out of both: there may be none.

/// Tables for testing every primitive in turn; regions come in the order of PlanarRegions, in blocks of one.
[[nodiscard]] Geometry brute_force(const scene::Scene& scene, bool in_double = false);

/// Tables with a hierarchy of max(2, lanes) children a node and blocks of `lanes` primitives.
[[nodiscard]] Geometry hierarchy(const scene::Scene& scene, int lanes, bool in_double = false);

/// Primitives that the scene's shapes stand for.
[[nodiscard]] std::uint64_t count_primitives(const scene::Scene& scene);

} // namespace phlux::accel
