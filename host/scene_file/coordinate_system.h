// The coordinate systems that Mitsuba puts around a direction, where a scene leaves one to it.
#pragma once

#include <cmath>

#include "scene/scene.h"

namespace phlux::scene_file {

/// The first of the two unit vectors that complete the unit vector n to a right-handed system: in versions 2
/// and 3 of the format by Duff et al. ("Building an Orthonormal Basis, Revisited", JCGT 6 (1), 2017), in
/// version 0 in the plane across the smaller of n.x and n.y.
[[nodiscard]] inline scene::Vec3 first_tangent(const scene::Vec3& n, int major_version) {
  if (major_version > 0) {
    const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z);
    return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
  }
  const scene::Vec3 second = std::abs(n.x) > std::abs(n.y)
                                 ? scene::Vec3(n.z, 0.0, -n.x) / std::hypot(n.x, n.z)
                                 : scene::Vec3(0.0, n.z, -n.y) / std::hypot(n.y, n.z);
  return glm::cross(second, n);
}

} // namespace phlux::scene_file
