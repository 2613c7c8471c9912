// A material whose sampling is measured, and the fixed direction.
#pragma once

#include <memory>

#include "lobes/models.h"

namespace phlux::bench {

/// A material, a grey Phong unless it is given, and the angle of the fixed direction.
struct Case {
  double diffuse = 0, specular = 0, exponent = 0; ///< kd, ks, n
  double degrees = 0;                             ///< between the fixed direction and the normal; below 90
  std::shared_ptr<const scene::Material> given = nullptr; ///< of another model; null: the Phong material
  bool operator==(const Case&) const = default;
};

/// The reflectivity rho = rho_d + rho_s of the Phong material for the fixed direction, in closed form and
/// double precision.
[[nodiscard]] double exact_reflectivity(const Case& one);

[[nodiscard]] scene::Material material_of(const Case& one);

} // namespace phlux::bench
