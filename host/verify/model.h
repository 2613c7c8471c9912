// The modified Phong model in float64 by CW 197 and its closed forms: the reference for the kernels, with
// which it shares neither code nor tables.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "measure/directions.h"
#include "scene/model.h"

namespace phlux::verify {

using namespace measure; // verification is of what host/measure measures

[[nodiscard]] inline bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Model {
  Rgb diffuse{0}, specular{0};
  double exponent = 0;

  [[nodiscard]] double diffuse_max() const;
  [[nodiscard]] double specular_max() const;
};

/// The parameters, rounded to float32 as on the device.
[[nodiscard]] Model model_of(const scene::Material& phong);

/// The direction at `angle` from z and `longitude` from x, in radians.
[[nodiscard]] Direction polar(double angle, double longitude);
/// The direction rounded to float32, as it is passed to the device.
[[nodiscard]] Direction as_float(const Direction& direction);

/// (n + 2) / 2 cos^n(alpha), 0 for alpha >= pi / 2. The directions need not be of unit length.
[[nodiscard]] double lobe(double exponent, const Direction& fixed, const Direction& generated);
/// Condition number of cos^n(alpha) as a function of 1 - cos(alpha), n (1 - cos(alpha)) / cos(alpha). Below
/// 20 where a lobe is not negligible, except for small n near alpha = pi / 2.
[[nodiscard]] double lobe_condition(double exponent, const Direction& fixed, const Direction& generated);
inline constexpr double well_conditioned = 20;
/// The relative error of cos^n(alpha) in float32 for a larger condition number: that of 1 - cos(alpha) is
/// 2^-22.
[[nodiscard]] double edge_error(double condition);

/// f_r; 0 if either direction is not above the surface.
[[nodiscard]] Rgb value(const Model& model, const Direction& fixed, const Direction& generated);

/// rho_s / ks for a fixed direction at this angle (radians), by quadrature over circles about the lobe's
/// axis; relative error below 1e-9.
[[nodiscard]] double lobe_reflectivity(double exponent, double angle);

/// Densities per solid angle of the parts of strategies. Those of `cosine`, `fold` and `exact` are 0 below
/// the surface; that of `lobe` is not.
[[nodiscard]] double cosine_density(const Direction& generated);
[[nodiscard]] double lobe_density(double exponent, const Direction& fixed, const Direction& generated);
[[nodiscard]] double fold_density(double exponent, const Direction& fixed, const Direction& generated);
[[nodiscard]] double exact_density(double exponent, double reflectivity, const Direction& fixed,
                                   const Direction& generated);

/// Height above the surface of the mirror image of `generated` in the plane through the lobe's axis that is
/// perpendicular to the plane of incidence.
[[nodiscard]] double image_height(const Direction& fixed, const Direction& generated);

} // namespace phlux::verify
