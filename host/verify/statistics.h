// Statistical tests in float64. A p-value is the probability of a result at least as bad under the null
// hypothesis.
#pragma once

#include <cstddef>
#include <vector>

namespace phlux::verify {

/// Probability of a false alarm of a whole verification, over all seeds. As seeds are fixed, a verification
/// that passes on a device always passes there.
inline constexpr double false_alarm_rate = 1e-4;

/// The limit of each of so many p-values, by Sidak's correction (1967).
[[nodiscard]] double sidak_limit(std::size_t p_values);

/// Pearson's chi-square test of observed against expected counts; cells with fewer than 10 expected are
/// pooled.
[[nodiscard]] double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected);

/// Upper tail of the chi-square distribution.
[[nodiscard]] double chi_square_tail(double statistic, double degrees);

/// Two-sided p-value of a mean that differs from its expectation by so many standard errors.
[[nodiscard]] double normal_p(double sigmas);

/// Running moments from float64 sums of powers, which at these counts are as accurate as Chan's update.
class Moments {
public:
  void add(double x) {
    const double x2 = x * x;
    ++count_;
    first_ += x;
    second_ += x2;
    third_ += x2 * x;
    fourth_ += x2 * x2;
  }
  [[nodiscard]] double count() const { return static_cast<double>(count_); }
  [[nodiscard]] double mean() const { return first_ / count(); }
  [[nodiscard]] double variance() const; ///< of one sample
  [[nodiscard]] double standard_error() const;
  [[nodiscard]] double variance_standard_error() const;

private:
  std::size_t count_ = 0;
  double first_ = 0, second_ = 0, third_ = 0, fourth_ = 0;
};

} // namespace phlux::verify
