// What long computations on a film report.
#pragma once

#include <functional>

namespace phlux::film {

/// Called now and then, at least once a second on any usual machine, with the share of the work that is done,
/// in [0, 1]. What it throws ends the work. Empty: not called.
using Progress = std::function<void(double done)>;

} // namespace phlux::film
