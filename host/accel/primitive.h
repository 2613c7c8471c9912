// Single primitives of a scene, relative to its centre, and the writer of their tables.
#pragma once

#include <array>
#include <cstdint>

#include "accel/geometry.h"

namespace phlux::accel {

using Float3 = std::array<float, 3>;

/// The element of the scene that a primitive is.
struct Reference {
  enum class Kind : std::uint8_t { mesh, patch, sphere };
  Kind kind;
  std::uint32_t object;  ///< mesh, patch or sphere
  std::uint32_t element; ///< triangle of the mesh
};

struct Box {
  Float3 low, high;
};

/// The centre of the scene's bounding box; (0, 0, 0) for a scene without shapes.
[[nodiscard]] scene::Vec3 middle(const scene::Scene& scene);

/// Bounding box of the primitive, relative to `origin`.
[[nodiscard]] Box bounds(const scene::Scene& scene, const scene::Vec3& origin, Reference reference);

/// False for a degenerate primitive: 1 / |edge_u x edge_v| is not finite in single precision. True for
/// spheres.
[[nodiscard]] bool has_area(const scene::Scene& scene, const scene::Vec3& origin, Reference reference,
                            bool in_double);

/// Appends primitives to a geometry's tables, whose `origin`, `block` and `in_double` are set.
class TableWriter {
public:
  TableWriter(const scene::Scene& scene, Geometry& geometry);
  /// A planar primitive that has_area().
  void add_planar(Reference reference);
  /// Pads the planar primitives to whole blocks and returns their number; no ray hits the padding.
  int finish_planar_block();
  /// Spheres have tables of their own until `finish`.
  void add_sphere(Reference reference);
  int finish_sphere_block();
  /// Appends the spheres to the planar primitives.
  void finish();

private:
  void write_planar(const std::array<double, PLANAR_FLOATS>& values);
  void write_sphere(const std::array<double, SPHERE_FLOATS>& values);
  void add_corners(Reference reference);
  void add_uv_map(Reference reference, const scene::Vec3& edge_u, const scene::Vec3& edge_v);

  const scene::Scene& scene_;
  Geometry& geometry_;
  const bool with_uv_;
  std::vector<float> sphere_uv_maps_;
  std::vector<PrimitiveRecord> sphere_records_;
  std::vector<int> sphere_emitters_;
  std::vector<EmittingPrimitive> emitting_spheres_;
  std::vector<std::size_t> first_normal_of_mesh_;
};

} // namespace phlux::accel
