// Extreme random words and directions, for which samplers are most likely to fail.
#pragma once

#include <vector>

#include "measure/device_model.h"

namespace phlux::verify {

/// All combinations of the smallest and largest numbers, their neighbours, and some between; fewer if `thin`.
[[nodiscard]] std::vector<measure::Words> extreme_words(bool thin);
/// The normal, close to the normal, grazing, in the tangent plane.
[[nodiscard]] std::vector<measure::Direction> extreme_directions();

} // namespace phlux::verify
