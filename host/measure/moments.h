// Mean and variance of samples with their standard errors; medians.
#pragma once

#include <cstdint>
#include <vector>

namespace phlux::measure {

/// Sums of the first four powers of d = sample - centre. A centre near the mean keeps cancellation small.
struct PowerSums {
  double d = 0, d2 = 0, d3 = 0, d4 = 0;
  std::uint64_t count = 0;
  double centre = 0;

  void add(double sample) {
    const double x = sample - centre, x2 = x * x;
    d += x;
    d2 += x2;
    d3 += x2 * x;
    d4 += x2 * x2;
    ++count;
  }
};

struct Moments {
  double mean = 0;
  double variance = 0;                ///< of one sample, unbiased
  double mean_standard_error = 0;     ///< sqrt(variance / count)
  double variance_standard_error = 0; ///< from the fourth central moment, asymptotically
};

/// Requires two samples or more. The variance of the sample variance is (m4 - (N - 3) / (N - 1) s^4) / N
/// (Kenney and Keeping 1951, 7.12), with the fourth central moment m4.
[[nodiscard]] Moments moments_of(const PowerSums& sums);

/// (mean - exact) / sqrt(standard error^2 + (float epsilon x exact)^2). The second term is the rounding error
/// of the samples, which remains where the estimator is constant.
[[nodiscard]] double bias_in_sigmas(const Moments& moments, double exact);

/// The middle value, or the mean of the two middle values. Requires one value or more.
[[nodiscard]] double median(std::vector<double> values);

} // namespace phlux::measure
