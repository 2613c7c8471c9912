// Mean and variance of samples, with what is known of their own errors; medians.
#pragma once

#include <cstdint>
#include <vector>

namespace phlux::bench {

/// Sums of the first four powers of d = sample - centre; `centre` near the mean keeps what is lost to
/// rounding small.
struct PowerSums {
  double d = 0, d2 = 0, d3 = 0, d4 = 0;
  std::uint64_t count = 0;
  double centre = 0;
};

struct Moments {
  double mean = 0;
  double variance = 0;                ///< of one sample, unbiased
  double mean_standard_error = 0;     ///< sqrt(variance / count)
  double variance_standard_error = 0; ///< from the fourth central moment; asymptotic
};

/// At least two samples. The variance of a sample variance is (m4 - (N - 3) / (N - 1) s^4) / N (Kenney and
/// Keeping 1951, 7.12), m4 being the fourth central moment.
[[nodiscard]] Moments moments_of(const PowerSums& sums);

/// (mean - exact) in units of the mean's standard error, which counts as at least one unit in the last place
/// of a float: where the integrand is constant, the error of the samples' mean is that of their arithmetic.
[[nodiscard]] double bias_in_sigmas(const Moments& moments, double exact);

/// The middle one, or the mean of the two in the middle. At least one value.
[[nodiscard]] double median(std::vector<double> values);

} // namespace phlux::bench
