// Reflectivity of the modified Phong lobe, and the table that kernels interpolate (kernels/phong/phong.cl).
#pragma once

#include <vector>

namespace phlux::phong {

/// Intervals of a row of the table, evenly spaced in the cosine.
inline constexpr int reflectivity_intervals = 1024;

/// rho_s / ks of the modified Phong lobe of exponent n >= 0 for an angle of incidence with this cosine, in
/// [0, 1]: CW 197's integral of cos^n(alpha) cos(theta), in closed form. Relative error below 1e-9.
[[nodiscard]] double lobe_reflectivity(double exponent, double cosine);

/// lobe_reflectivity at cosine 0: Gamma((n + 1) / 2) / (2 sqrt(pi) Gamma(n / 2 + 1))
/// (kernels/phong/sampling.md).
[[nodiscard]] double grazing_reflectivity(double exponent);

/// The cosine above which the horizon clips so little of the lobe that its reflectivity is ks cos(theta); the
/// last one of the table's row.
[[nodiscard]] double whole_lobe_cosine(double exponent);

/// Appends a row for the exponent: reflectivity_intervals + 1 values at cosines from 0 to
/// whole_lobe_cosine(). Returns the index of the first value.
int append_reflectivities(double exponent, std::vector<float>& table);

} // namespace phlux::phong
