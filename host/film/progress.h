// Progress of long computations on a film.
#pragma once

#include <functional>

namespace phlux::film {

/// Called about once a second or more often, with the share of the work that is done, in [0, 1]. An exception
/// that it throws ends the work. Not called if empty.
using Progress = std::function<void(double done)>;

} // namespace phlux::film
