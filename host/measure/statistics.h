// Statistical tests in float64. A p-value is the probability of a result at least as bad under the null
// hypothesis.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace phlux::measure {

/// The limit of each of so many independent p-values for which all of them together have the false-alarm
/// probability `rate` (Sidak 1967).
[[nodiscard]] inline double sidak_limit(double rate, std::size_t p_values) {
  return -std::expm1(std::log1p(-rate) / static_cast<double>(std::max<std::size_t>(p_values, 1)));
}
/// The probability that the smallest of so many independent p-values is at most p.
[[nodiscard]] inline double smallest_p(double p, std::size_t p_values) {
  return p < 1 ? -std::expm1(static_cast<double>(p_values) * std::log1p(-p)) : 1;
}

/// Pearson's chi-square test of observed against expected counts; cells with fewer than 10 expected are
/// pooled.
[[nodiscard]] double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected);

/// Upper tail of the chi-square distribution.
[[nodiscard]] double chi_square_tail(double statistic, double degrees);

/// Two-sided p-value of Student's t with so many degrees of freedom.
[[nodiscard]] double student_p(double t, double degrees);
/// The inverse: t with this two-sided p-value, in (0, 1].
[[nodiscard]] double student_t(double p, double degrees);

/// Two-sided p-value of a mean that differs from its expectation by so many standard errors.
[[nodiscard]] double normal_p(double sigmas);
/// The inverse: the number of standard errors with this two-sided p-value, in (0, 1].
[[nodiscard]] double normal_sigmas(double p);

} // namespace phlux::measure
