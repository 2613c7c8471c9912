// One primitive at a time, taken from the scene's shapes about the scene's middle, in float precision where
// the tables are of floats.
#pragma once

#include <array>
#include <cstdint>

#include "accel/geometry.h"

namespace phlux::accel {

using Float3 = std::array<float, 3>;

/// Which element of the scene a primitive is.
struct Reference {
  enum class Kind : std::uint8_t { mesh, patch, sphere };
  Kind kind;
  std::uint32_t object;  ///< mesh, patch or sphere
  std::uint32_t element; ///< triangle of the mesh
};

struct Box {
  Float3 low, high;
};

/// The middle of the scene's bounding box; (0, 0, 0) for a scene without shapes.
[[nodiscard]] scene::Vec3 middle(const scene::Scene& scene);

/// A box that holds the primitive, in coordinates about `origin`.
[[nodiscard]] Box bounds(const scene::Scene& scene, const scene::Vec3& origin, Reference reference);

/// Whether the primitive has an area that single precision can tell from 0; spheres have.
[[nodiscard]] bool has_area(const scene::Scene& scene, const scene::Vec3& origin, Reference reference,
                            bool in_double);

/// Appends primitives to a geometry's tables, whose `origin`, `block` and `in_double` are set.
class TableWriter {
public:
  TableWriter(const scene::Scene& scene, Geometry& geometry);
  /// A flat primitive that has_area().
  void add_planar(Reference reference);
  /// Flat primitives so far, rounded up to a whole block by fillers that nothing meets.
  int finish_planar_block();
  /// Spheres go to tables of their own until `finish`.
  void add_sphere(Reference reference);
  int finish_sphere_block();
  /// Puts the spheres behind the flat primitives.
  void finish();

private:
  void write_planar(const std::array<double, PLANAR_FLOATS>& values);
  void write_sphere(const std::array<double, SPHERE_FLOATS>& values);
  void add_corners(Reference reference);

  const scene::Scene& scene_;
  Geometry& geometry_;
  std::vector<PrimitiveRecord> sphere_records_;
  std::vector<int> sphere_emitters_;
  std::vector<EmittingPrimitive> emitting_spheres_;
  std::vector<std::size_t> first_normal_of_mesh_;
};

} // namespace phlux::accel
