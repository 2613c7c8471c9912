#include "bench/sampling/radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "measure/sampling_radiance.h"

namespace phlux::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double disk_angle = MIRROR_DISK_DEGREES * pi / 180;
const double disk_radiance = 1 / (1 - std::cos(disk_angle));
constexpr double sky_height = 0.05;
const double sky_scale = 1 / std::log((1 + sky_height) / sky_height);

template<typename Function>
double integral(const Function& function, double from, double to) {
  constexpr unsigned deepest = 9;
  constexpr double tolerance = 1e-10;
  return boost::math::quadrature::gauss_kronrod<double, 21>::integrate(function, from, to, deepest,
                                                                       tolerance);
}

// L_i cos(theta) as a function of cos(theta). For the disk, without the radiance of the disk.
double incident(Light light, double cosine) {
  return light == Light::horizon_sky ? sky_scale * cosine / (cosine + sky_height) : cosine;
}

// Integral of L_i cos(theta) over longitude, along the part above the surface of the circle at angle `alpha`
// about the lobe axis; the axis is at `angle` from the normal. For the disk, without its radiance.
double circle_integral(Light light, double angle, double alpha) {
  const double along = std::cos(angle) * std::cos(alpha), across = std::sin(angle) * std::sin(alpha);
  if (across <= -along) return 0;
  const double turn = across <= along ? pi : std::acos(-along / across);
  if (light != Light::horizon_sky) return 2 * (along * turn + across * std::sin(turn));
  return 2 *
         integral([&](double phi) { return incident(light, std::max(0.0, along + across * std::cos(phi))); },
                  0.0, turn);
}

// Integral of cos^n(alpha) L_i cos(theta) over solid angle, in a cap of angle `radius` about the lobe axis.
double cap_integral(Light light, double exponent, double angle, double radius) {
  const double width = 1 / std::sqrt(exponent + 1), dip = pi / 2 - angle;
  std::vector<double> cuts{0, radius};
  for (const double widths : {0.5, 1., 2., 3., 4., 6., 9.}) cuts.push_back(widths * width);
  for (const double beyond : {-.2, -.05, 0., .05, .2})
    cuts.push_back(dip + beyond);                 // the radiance of the sky peaks at the horizon
  const double end = std::min(radius, 9 * width); // cos^n is below 1e-17 beyond
  std::erase_if(cuts, [&](double cut) { return cut < 0 || cut > end; });
  cuts.push_back(end);
  std::ranges::sort(cuts);
  const auto integrand = [&](double alpha) {
    const double power = std::exp(exponent * std::log1p(-2 * std::pow(std::sin(alpha / 2), 2)));
    return power * std::sin(alpha) * circle_integral(light, angle, alpha);
  };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double from = cuts[i], length = cuts[i + 1] - from;
    if (length < 1e-14) continue;
    // alpha = from + length t^2 removes the square-root singularity where the circle begins to cross the
    // horizon.
    sum += integral([&](double t) { return integrand(from + length * t * t) * 2 * t * length; }, 0.0, 1.0);
  }
  return sum;
}

// 1 / pi times the integral of L_i cos(theta) over the hemisphere: the diffuse part for kd = 1.
double diffuse_part(Light light, double angle) {
  if (light == Light::mirror_disk) return disk_radiance / pi * cap_integral(light, 0, angle, disk_angle);
  return 2 * integral([&](double cosine) { return incident(light, cosine); }, 0.0, 1.0);
}

double specular_part(Light light, double exponent, double angle) {
  const double norm = (exponent + 2) / (2 * pi);
  if (light == Light::mirror_disk)
    return norm * disk_radiance * cap_integral(light, exponent, angle, disk_angle);
  return norm * cap_integral(light, exponent, angle, pi / 2);
}

} // namespace

const std::vector<std::string>& light_names() {
  static const std::vector<std::string> names = {"constant", "mirror-disk", "horizon-sky"};
  return names;
}

double integrated_radiance(const Case& one, Light light) {
  const double angle = one.degrees * pi / 180;
  const double diffuse = one.diffuse > 0 ? one.diffuse * diffuse_part(light, angle) : 0;
  return diffuse + one.specular * specular_part(light, one.exponent, angle);
}

double reflected_radiance(const Case& one, Light light) {
  return light == Light::constant ? exact_reflectivity(one) : integrated_radiance(one, light);
}

} // namespace phlux::bench
