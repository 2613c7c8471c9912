// Statistical tests in float64. Each gives a p-value, the probability of a result at least as bad were all
// well.
#pragma once

#include <cstddef>
#include <vector>

namespace phlux::verify {

/// A verification raises a false alarm with this probability, were its seeds drawn anew. They are fixed: what
/// passes on a device keeps passing there.
inline constexpr double false_alarm_rate = 1e-4;

/// The p-value at which each of so many questions must be asked (Sidak 1967).
[[nodiscard]] double one_of(std::size_t questions);

/// Pearson's chi-square of observed counts against expected ones; cells that expect fewer than 10 are pooled.
[[nodiscard]] double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected);

/// Upper tail of the chi-square distribution.
[[nodiscard]] double chi_square_tail(double statistic, double degrees);

/// That a mean lies so many standard errors from where it should, either way.
[[nodiscard]] double normal_p(double sigmas);

/// Running moments of a quantity: Chan's update would do no better at these counts than float64 sums about 0.
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
