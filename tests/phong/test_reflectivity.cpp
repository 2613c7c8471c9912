// The reflectivity of a lobe on the host.
// In debug builds Boost 1.74 asserts that tanh_sinh rounds no point to an end of the interval, but it does.
#define BOOST_DISABLE_ASSERTS
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include "phong/reflectivity.h"

namespace {

constexpr double pi = std::numbers::pi;

// Integral of the lobe over the hemisphere from its definition: a closed form for the part of a circle of
// constant alpha above the horizon, then quadrature over alpha.
double reflectivity_by_quadrature(double exponent, double cosine) {
  const double theta = std::acos(cosine), c = cosine, s = std::sin(theta);
  const auto circle = [&](double alpha) { // integral of max(cos(theta_o), 0) over longitude
    const double along = c * std::cos(alpha), across = s * std::sin(alpha);
    if (along >= across) return 2 * pi * along;
    const double horizon = std::acos(std::max(-1.0, along / across));
    return 2 * along * (pi - horizon) + 2 * across * std::sin(horizon);
  };
  const auto integrand = [&](double alpha) {
    const double half = std::sin(alpha / 2);
    return std::exp(exponent * std::log1p(-2 * half * half)) * std::sin(alpha) * circle(alpha);
  };
  // Intervals end where circles begin to cross the horizon, and are not much wider than the lobe.
  boost::math::quadrature::tanh_sinh<double> rule;
  std::vector<double> cuts{0, pi / 2 - theta, pi / 2};
  for (double width = 1 / std::sqrt(exponent + 1); width < pi / 2; width *= 2) cuts.push_back(width);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (cuts[i + 1] - cuts[i] > 1e-15) sum += rule.integrate(integrand, cuts[i], cuts[i + 1], 1e-12);
  return sum * (exponent + 2) / (2 * pi);
}

double degrees(double angle) {
  return std::cos(angle * pi / 180);
}

} // namespace

TEST_CASE("lobe_reflectivity is the integral's, by quadrature") {
  for (const double exponent : {0.0, 0.5, 1.0, 10.0, 50.0, 1000.0, 1e5, 1e6})
    for (const double angle : {0.0, 1e-3, 5.0, 30.0, 45.0, 60.0, 75.0, 85.0, 88.0, 89.0, 89.9, 89.99, 90.0}) {
      CAPTURE(exponent, angle);
      const double by_quadrature = reflectivity_by_quadrature(exponent, angle == 90 ? 0.0 : degrees(angle));
      const double closed = phlux::phong::lobe_reflectivity(exponent, angle == 90 ? 0.0 : degrees(angle));
      CHECK(std::abs(closed - by_quadrature) <= 1e-9 * by_quadrature);
    }
}

TEST_CASE("lobe_reflectivity has the known values") {
  using phlux::phong::lobe_reflectivity;
  CHECK(lobe_reflectivity(50, degrees(30)) == Approx(0.86602540).margin(5e-9));
  CHECK(lobe_reflectivity(10, degrees(60)) == Approx(0.50473595).margin(5e-9));
  CHECK(lobe_reflectivity(10, degrees(75)) == Approx(0.29190102).margin(5e-9));
  CHECK(lobe_reflectivity(50, degrees(85)) == Approx(0.11006323).margin(5e-9));
  CHECK(lobe_reflectivity(100, degrees(89)) == Approx(0.04912536).margin(5e-9));
  CHECK(lobe_reflectivity(1000, degrees(89)) == Approx(0.02321229).margin(5e-9));
  CHECK(lobe_reflectivity(50, 1) == Approx(1).margin(1e-12));
  for (const double c : {0.0, 0.3, 1.0}) CHECK(lobe_reflectivity(0, c) == Approx((1 + c) / 2).margin(1e-12));
}
