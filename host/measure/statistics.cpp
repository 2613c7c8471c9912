#include "measure/statistics.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace phlux::measure {

double chi_square_tail(double statistic, double degrees) {
  return boost::math::gamma_q(degrees / 2, statistic / 2);
}

double student_p(double t, double degrees) {
  const boost::math::students_t distribution(degrees);
  return std::isfinite(t) ? 2 * boost::math::cdf(boost::math::complement(distribution, std::abs(t))) : 0;
}

double student_t(double p, double degrees) {
  const boost::math::students_t distribution(degrees);
  return boost::math::quantile(boost::math::complement(distribution, p / 2));
}

double normal_p(double sigmas) {
  return std::erfc(std::abs(sigmas) / std::sqrt(2.0));
}

double normal_sigmas(double p) {
  return std::sqrt(2.0) * boost::math::erfc_inv(p);
}

double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected) {
  constexpr double fewest = 10;
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
  // A pool with fewer than one expected sample is no cell, but many samples in it are an error.
  if (pooled_expected >= 1)
    add(pooled_observed, pooled_expected);
  else if (pooled_observed > 10)
    return 0;
  return cells > 1 ? chi_square_tail(statistic, cells - 1) : 1;
}

} // namespace phlux::measure
