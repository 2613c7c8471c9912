#include "measure/moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace phlux::measure {

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
  const double arithmetic = static_cast<double>(std::numeric_limits<float>::epsilon()) * std::abs(exact);
  return (moments.mean - exact) / std::hypot(moments.mean_standard_error, arithmetic);
}

double median(std::vector<double> values) {
  assert(!values.empty());
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

} // namespace phlux::measure
