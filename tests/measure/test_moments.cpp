#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "measure/moments.h"

using namespace phlux::measure;

namespace {

PowerSums sums_of(const std::vector<double>& samples, double centre) {
  PowerSums sums;
  sums.centre = centre;
  for (const double sample : samples) sums.add(sample);
  return sums;
}

} // namespace

TEST_CASE("Moments of four numbers, for several centres") {
  for (const double centre : {0.0, 2.5, 7.0}) {
    const Moments m = moments_of(sums_of({1, 2, 3, 6}, centre));
    CHECK(m.mean == Approx(3));
    CHECK(m.variance == Approx(14.0 / 3));
    CHECK(m.mean_standard_error == Approx(std::sqrt(14.0 / 12)));
    // m2 = 3.5, m4 = (16 + 1 + 0 + 81) / 4 = 24.5
    CHECK(m.variance_standard_error == Approx(std::sqrt((24.5 - 3.5 * 3.5 / 3) / 4)));
  }
}

TEST_CASE("Bias is in standard errors of the mean") {
  const Moments m = moments_of(sums_of({1, 2, 3, 6}, 3));
  CHECK(bias_in_sigmas(m, 2) == Approx(1 / std::sqrt(14.0 / 12)));
  const Moments constant = moments_of(sums_of({.5, .5, .5}, .5));
  CHECK(bias_in_sigmas(constant, .5) == 0);
  CHECK(std::abs(bias_in_sigmas(constant, .5 * (1 + 6e-8))) < 1); // rounding of float32 is not a bias
  CHECK(bias_in_sigmas(constant, .4) > 1e5);
}

TEST_CASE("moments: the median of an odd and of an even number of values") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 2}) == 2);
  CHECK(median({8, 1, 4, 2}) == 3);
}
