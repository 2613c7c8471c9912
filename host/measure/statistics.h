// Statistical tests in float64. Each gives a p-value, the probability of a result at least as bad were all
// well.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace phlux::measure {

/// The p-value at which each of so many independent questions must be asked, that all of them together raise
/// a false alarm with probability `rate` (Sidak 1967).
[[nodiscard]] inline double level_of_each(double rate, std::size_t questions) {
  return -std::expm1(std::log1p(-rate) / static_cast<double>(std::max<std::size_t>(questions, 1)));
}
/// The chance that one of so many questions has this p-value or less.
[[nodiscard]] inline double least_p_of(double p, std::size_t questions) {
  return p < 1 ? -std::expm1(static_cast<double>(questions) * std::log1p(-p)) : 1;
}

/// Pearson's chi-square of observed counts against expected ones; cells that expect fewer than 10 are pooled.
[[nodiscard]] double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected);

/// Upper tail of the chi-square distribution.
[[nodiscard]] double chi_square_tail(double statistic, double degrees);

/// That a mean lies so many standard errors from where it should, either way.
[[nodiscard]] double normal_p(double sigmas);

} // namespace phlux::measure
