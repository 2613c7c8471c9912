// The materials of a model that are verified, and the directions.
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

/// The defaults; the defaults with `assignments`, where there are some; and those with each other parameter
/// at either end of its range. Where a colour is at its highest the other colours are at their lowest, as the
/// sum of reflectances may be bounded. Ranges that end beyond 1000 are tried at 1000. A model that ships is
/// never sampled where it is black.
/// @throws UsageError as lobes::assign
[[nodiscard]] std::vector<NamedMaterial> materials_of(const lobes::ModelPointer& model,
                                                      const Assignments& assignments);

struct FixedDirection {
  Direction direction;
  std::string name; ///< such as "60 degrees, longitude 126"
};
/// From the normal to 89.9 degrees, at several longitudes: models may be anisotropic.
[[nodiscard]] std::vector<FixedDirection> fixed_directions(bool quick);

} // namespace phlux::verify
