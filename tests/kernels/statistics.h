// Statistical tests. Each returns a p-value; a test case with many questions compares it with
// one_of(questions), so that with a random seed the whole case raises a false alarm with probability
// false_alarm_rate (Sidak 1967). Seeds are fixed, so a test that passes keeps passing.
#pragma once

#include <cmath>
#include <vector>

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include "sidak.h"

namespace device_test {

inline constexpr double false_alarm_rate = 1e-3;

/// The significance level of each of many questions.
inline double one_of(std::size_t questions) {
  return phlux::test::level_of_each(false_alarm_rate, questions);
}

/// Pearson's chi-square test of observed and expected counts; cells with small expected counts are pooled.
inline double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected) {
  constexpr double fewest = 8;
  double statistic = 0, pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  const auto add = [&](double seen, double hoped) {
    statistic += (seen - hoped) * (seen - hoped) / hoped;
    ++cells;
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] >= fewest) {
      add(observed[i], expected[i]);
    } else {
      pooled_observed += observed[i];
      pooled_expected += expected[i];
    }
  }
  // If even the pool has an expected count below 1, its observed count must be small.
  if (pooled_expected >= 1)
    add(pooled_observed, pooled_expected);
  else if (pooled_observed > 5)
    return 0;
  return cells > 1 ? boost::math::gamma_q((cells - 1) / 2.0, statistic / 2) : 1;
}

/// Two-sided test that a mean with this standard error is `expected`.
inline double mean_p(double mean, double standard_error, double expected) {
  if (std::abs(mean - expected) <= 1e-5 * std::abs(expected)) return 1; // rounding of weights in float32
  return standard_error > 0 ? boost::math::erfc(std::abs(mean - expected) / standard_error / std::sqrt(2.0))
                            : 0;
}

} // namespace device_test
