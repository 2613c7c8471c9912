// Distances to the surfaces of a scene, by rays on the host.
#pragma once

#include <optional>

#include "accel/geometry.h"

namespace phlux::test {

class Surfaces {
public:
  struct Hit {
    double distance;
    double cosine; ///< between the ray and the normal, not negative
  };
  struct Place {
    scene::Vec3 position, normal; ///< normal: of a sphere, (0, 0, 0)
  };

  /// `geometry` must have no hierarchy, blocks of one and double precision, and must outlive this.
  explicit Surfaces(const accel::Geometry& geometry) : geometry_(geometry) {}
  /// In the geometry's coordinates; `direction` is a unit vector.
  [[nodiscard]] std::optional<Hit> first_hit(const scene::Vec3& origin, const scene::Vec3& direction) const;
  [[nodiscard]] Place middle(int primitive) const;

private:
  [[nodiscard]] std::optional<Hit> planar_hit(std::size_t primitive, const scene::Vec3& origin,
                                              const scene::Vec3& direction) const;
  [[nodiscard]] std::optional<Hit> sphere_hit(std::size_t sphere, const scene::Vec3& origin,
                                              const scene::Vec3& direction) const;

  const accel::Geometry& geometry_;
};

} // namespace phlux::test
