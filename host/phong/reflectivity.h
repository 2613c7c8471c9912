// What a modified Phong lobe reflects, and the table of it that kernels interpolate (kernels/phong/phong.cl).
#pragma once

#include <vector>

namespace phlux::phong {

/// Intervals of a row of the table, evenly spaced in the cosine.
inline constexpr int reflectivity_intervals = 1024;

/// rho_s / ks of the modified Phong lobe of exponent n >= 0 for light whose angle with the normal has this
/// cosine (0 to 1): CW 197's integral over cos^n(alpha) cos(theta), in closed form. Relative error below
/// 1e-9.
[[nodiscard]] double lobe_reflectivity(double exponent, double cosine);

/// The same at grazing incidence, cosine 0: Gamma((n + 1) / 2) / (2 sqrt(pi) Gamma(n / 2 + 1))
/// (kernels/phong/sampling.md).
[[nodiscard]] double grazing_reflectivity(double exponent);

/// The cosine from which on the lobe is so far above the horizon that it reflects just ks cos(theta): the
/// last one of its row.
[[nodiscard]] double whole_lobe_cosine(double exponent);

/// Appends the row of this exponent: reflectivity_intervals + 1 values, at cosines from 0 to
/// whole_lobe_cosine(). Returns the index of its first value.
int append_reflectivities(double exponent, std::vector<float>& table);

} // namespace phlux::phong
