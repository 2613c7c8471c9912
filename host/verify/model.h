// The modified Phong model in float64, as CW 197 and its closed forms state it: what the kernels are measured
// against. It shares no code with them, nor with the tables that they read.
#pragma once

#include <string>
#include <vector>

#include "measure/directions.h"
#include "scene/model.h"

namespace phlux::verify {

using namespace measure; // verification is of what host/measure measures

struct Model {
  Rgb diffuse{0}, specular{0};
  double exponent = 0;

  [[nodiscard]] double diffuse_max() const;
  [[nodiscard]] double specular_max() const;
};

/// The parameters that the device computes with: float32's.
[[nodiscard]] Model model_of(const scene::Material& phong);

/// z turned by `angle`, at `longitude` from x; radians.
[[nodiscard]] Direction polar(double angle, double longitude);
/// The nearest float32 direction, which is what the device is given.
[[nodiscard]] Direction as_float(const Direction& direction);

/// (n + 2) / 2 cos^n(alpha), 0 where alpha is pi / 2 or more. The directions' lengths do not matter.
[[nodiscard]] double lobe(double exponent, const Direction& fixed, const Direction& generated);
/// By how much cos^n(alpha) magnifies a relative error of 1 - cos(alpha), which is all that float32 makes on
/// the way: n (1 - cos(alpha)) / cos(alpha). Below 20 wherever a lobe has weight, but for small n near alpha
/// = pi / 2.
[[nodiscard]] double lobe_condition(double exponent, const Direction& fixed, const Direction& generated);
inline constexpr double well_conditioned = 20;
/// The relative error of cos^n(alpha) in float32 where its condition is larger: (1 - cos(alpha)) is off by
/// 2^-22.
[[nodiscard]] double edge_error(double condition);

/// f_r; 0 where either direction is not above the surface.
[[nodiscard]] Rgb value(const Model& model, const Direction& fixed, const Direction& generated);

/// rho_s / ks for a fixed direction at this angle (radians), by quadrature over circles about the lobe's
/// axis; relative error below 1e-9.
[[nodiscard]] double lobe_reflectivity(double exponent, double angle);

/// Densities per solid angle that strategies are made of. `fold` and `exact` vanish below the surface, `lobe`
/// does not.
[[nodiscard]] double cosine_density(const Direction& generated);
[[nodiscard]] double lobe_density(double exponent, const Direction& fixed, const Direction& generated);
[[nodiscard]] double fold_density(double exponent, const Direction& fixed, const Direction& generated);
[[nodiscard]] double exact_density(double exponent, double reflectivity, const Direction& fixed,
                                   const Direction& generated);

/// How far the image of `generated`, mirrored about the plane through the lobe's axis across the plane of
/// incidence, is above the surface.
[[nodiscard]] double image_height(const Direction& fixed, const Direction& generated);

} // namespace phlux::verify
