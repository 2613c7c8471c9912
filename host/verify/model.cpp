#include "verify/model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <glm/geometric.hpp>

namespace phlux::verify {
namespace {

constexpr double pi = std::numbers::pi;

Direction mirrored(const Direction& fixed) {
  return glm::normalize(Direction(-fixed.x, -fixed.y, fixed.z));
}

// cos^n(alpha) from the chord between the directions, without cancellation for large exponents.
double cosine_power(double exponent, const Direction& fixed, const Direction& generated) {
  const double chord = glm::length(mirrored(fixed) - glm::normalize(generated));
  const double one_minus_cosine = chord * chord / 2;
  return one_minus_cosine < 1 ? std::exp(exponent * std::log1p(-one_minus_cosine)) : 0.0;
}

// The integral of the cosine with the normal along the part above the surface of the circle at `alpha` about
// the lobe's axis, which is at `angle` from the normal.
double circle_integral(double angle, double alpha) {
  const double along = std::cos(angle) * std::cos(alpha), across = std::sin(angle) * std::sin(alpha);
  const double turn = across <= along ? pi : std::acos(-along / across);
  return 2 * (along * turn + across * std::sin(turn));
}

} // namespace

double Model::diffuse_max() const {
  return std::max({diffuse.r, diffuse.g, diffuse.b});
}
double Model::specular_max() const {
  return std::max({specular.r, specular.g, specular.b});
}

Model model_of(const scene::Material& phong) {
  return {as_float(phong.value("diffuse_reflectance")), as_float(phong.value("specular_reflectance")),
          as_float(phong.value("exponent")).x};
}

Direction polar(double angle, double longitude) {
  return {std::sin(angle) * std::cos(longitude), std::sin(angle) * std::sin(longitude), std::cos(angle)};
}

Direction as_float(const Direction& direction) {
  // `volatile`, as GCC 12 at -O2 drops a conversion to float and back that it vectorises.
  const auto rounded = [](double value) {
    const volatile float narrow = static_cast<float>(value);
    return static_cast<double>(narrow);
  };
  return {rounded(direction.x), rounded(direction.y), rounded(direction.z)};
}

double lobe(double exponent, const Direction& fixed, const Direction& generated) {
  return (exponent + 2) / 2 * cosine_power(exponent, fixed, generated);
}

double lobe_condition(double exponent, const Direction& fixed, const Direction& generated) {
  const double chord = glm::length(mirrored(fixed) - glm::normalize(generated));
  const double cosine = 1 - chord * chord / 2;
  return cosine > 0 ? exponent * (1 - cosine) / cosine : 0; // the lobe is 0 beyond pi / 2
}

double edge_error(double condition) {
  return std::expm1(condition * 0x1p-22) + 1e-5;
}

Rgb value(const Model& model, const Direction& fixed, const Direction& generated) {
  if (fixed.z <= 0 || generated.z <= 0) return Rgb(0);
  return (model.diffuse + model.specular * lobe(model.exponent, fixed, generated)) / pi;
}

double lobe_reflectivity(double exponent, double angle) {
  // Intervals end where the circles begin to intersect the surface; they are short where the lobe falls off.
  std::vector<double> cuts{0, pi / 2, std::max(0.0, pi / 2 - angle)};
  const double width = 1 / std::sqrt(exponent + 1);
  for (const double widths : {0.5, 1., 1.5, 2., 2.5, 3., 4., 5., 6., 8.})
    if (widths * width < pi / 2) cuts.push_back(widths * width);
  std::sort(cuts.begin(), cuts.end());
  const auto integrand = [&](double alpha) {
    const double power = std::exp(exponent * std::log1p(-2 * std::pow(std::sin(alpha / 2), 2)));
    return power * std::sin(alpha) * circle_integral(angle, alpha);
  };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size() && cuts[i] < 9 * width; ++i) {
    const double from = cuts[i], to = cuts[i + 1];
    if (to - from < 1e-14) continue;
    // The substitution alpha = from + (to - from) t^2 removes the square root at which a circle meets the
    // surface.
    using Rule = boost::math::quadrature::gauss<double, 20>;
    sum += Rule::integrate(
        [&](double t) { return integrand(from + (to - from) * t * t) * 2 * t * (to - from); }, 0.0, 1.0);
  }
  return (exponent + 2) / (2 * pi) * sum;
}

double cosine_density(const Direction& generated) {
  return std::max(generated.z, 0.0) / pi;
}

double lobe_density(double exponent, const Direction& fixed, const Direction& generated) {
  return (exponent + 1) / (2 * pi) * cosine_power(exponent, fixed, generated);
}

double image_height(const Direction& fixed, const Direction& generated) {
  const double sine = std::hypot(fixed.x, fixed.y);
  if (sine == 0) return generated.z;
  const Direction axis = mirrored(fixed), outward(-fixed.x / sine, -fixed.y / sine, 0);
  const Direction across = glm::normalize(outward - axis * glm::dot(outward, axis)); // of the axis, outwards
  const Direction image = generated - 2 * glm::dot(generated, across) * across;
  return image.z;
}

double fold_density(double exponent, const Direction& fixed, const Direction& generated) {
  if (generated.z <= 0) return 0;
  return (image_height(fixed, generated) < 0 ? 2 : 1) * lobe_density(exponent, fixed, generated);
}

double exact_density(double exponent, double reflectivity, const Direction& fixed,
                     const Direction& generated) {
  return lobe(exponent, fixed, generated) * std::max(generated.z, 0.0) / (pi * reflectivity);
}

} // namespace phlux::verify
