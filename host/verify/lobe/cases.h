// The materials and directions with which a model is verified.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lobes/assignment.h"
#include "verify/model.h"

namespace phlux::verify {

/// NAME and VALUE of parameters, as a user sets them.
using Assignments = std::vector<std::pair<std::string, std::string>>;

struct NamedMaterial {
  scene::Material material;
  std::string name; ///< such as "exponent 1000", or "defaults"
};

/// The default material; the same with `assignments`, if any; and that with each other parameter at either
/// end of its range, or at 1000 if the range is larger. When a colour is at its highest the other colours are
/// at their lowest, as the sum of reflectances may be bounded. Without black materials of built-in models.
/// @throws UsageError as lobes::assign
[[nodiscard]] std::vector<NamedMaterial> materials_of(const lobes::ModelPointer& model,
                                                      const Assignments& assignments);

struct FixedDirection {
  Direction direction;
  std::string name; ///< such as "60 degrees, longitude 126"
};
/// From the normal to 89.9 degrees, at several longitudes: models may be anisotropic; on the back of the
/// surface too if light passes through.
[[nodiscard]] std::vector<FixedDirection> fixed_directions(bool quick, bool both_sides);

} // namespace phlux::verify
