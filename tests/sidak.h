// One false-alarm rate for many independent tests (Sidak 1967).
#pragma once

#include <cmath>
#include <cstddef>

namespace phlux::test {

/// The p-value at which each of `tests` must be asked for `rate` of all of them.
inline double level_of_each(double rate, std::size_t tests) {
  return -std::expm1(std::log1p(-rate) / static_cast<double>(tests));
}

/// The chance that one of `tests` has this p or less.
inline double least_p_of(double p, std::size_t tests) {
  return p < 1 ? -std::expm1(static_cast<double>(tests) * std::log1p(-p)) : 1;
}

} // namespace phlux::test
