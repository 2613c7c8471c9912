// Statistical questions of the tests of kernels. A test case that asks many compares each p-value with
// one_of(questions): the whole case raises a false alarm with probability false_alarm_rate were its seed
// drawn anew. Seeds are fixed, so a test that passes keeps passing.
#pragma once

#include <cmath>

#include "measure/statistics.h"

namespace device_test {

using phlux::measure::chi_square_p;

inline constexpr double false_alarm_rate = 1e-3;

/// The level at which one of many questions must be asked.
inline double one_of(std::size_t questions) {
  return phlux::measure::sidak_limit(false_alarm_rate, questions);
}

/// That a mean with this standard error is `expected`, two-sided.
inline double mean_p(double mean, double standard_error, double expected) {
  if (std::abs(mean - expected) <= 1e-5 * std::abs(expected)) return 1; // weights of float precision
  return standard_error > 0 ? phlux::measure::normal_p((mean - expected) / standard_error) : 0;
}

} // namespace device_test
