#include "bench/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phlux::bench {

Moments moments_of(const PowerSums& sums) {
  const auto n = static_cast<double>(sums.count);
  const double a = sums.d / n, a2 = sums.d2 / n, a3 = sums.d3 / n, a4 = sums.d4 / n;
  const double m2 = std::max(0.0, a2 - a * a);
  const double m4 = a4 - 4 * a * a3 + 6 * a * a * a2 - 3 * a * a * a * a;
  Moments moments;
  moments.mean = sums.centre + a;
  moments.variance = m2 * n / (n - 1);
  moments.mean_standard_error = std::sqrt(moments.variance / n);
  moments.variance_standard_error = std::sqrt(std::max(0.0, (m4 - (n - 3) / (n - 1) * m2 * m2) / n));
  return moments;
}

double bias_in_sigmas(const Moments& moments, double exact) {
  constexpr double float_precision = 2e-6; // of weights and of the tabulated reflectivity where it is linear
  const double bias = moments.mean - exact;
  if (moments.mean_standard_error > 0) return bias / moments.mean_standard_error;
  return std::abs(bias) <= float_precision * exact
             ? 0
             : std::copysign(std::numeric_limits<double>::infinity(), bias);
}

} // namespace phlux::bench
