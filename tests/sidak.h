// One false-alarm rate for many independent tests (Sidak 1967).
#pragma once

#include <cmath>
#include <cstddef>

namespace phlux::test {

/// The significance level of each of `tests` for a false-alarm rate `rate` of all.
inline double level_of_each(double rate, std::size_t tests) {
  return -std::expm1(std::log1p(-rate) / static_cast<double>(tests));
}

/// The probability that the least p-value of `tests` is at most p.
inline double least_p_of(double p, std::size_t tests) {
  return p < 1 ? -std::expm1(static_cast<double>(tests) * std::log1p(-p)) : 1;
}

} // namespace phlux::test
