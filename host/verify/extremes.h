// The random words and the directions at which samplers fail, if they do.
#pragma once

#include <vector>

#include "measure/device_model.h"

namespace phlux::verify {

/// All combinations of the first and last numbers, of those next to them, and of some between; fewer where
/// `thin`.
[[nodiscard]] std::vector<measure::Words> extreme_words(bool thin);
/// The normal, nearly the normal, grazing, in the tangent plane.
[[nodiscard]] std::vector<measure::Direction> extreme_directions();

} // namespace phlux::verify
