// Spectra as linear sRGB colours (Rec. 709 primaries, white point D65), by the CIE 1931 colour matching
// functions.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace phlux::scene_file {

/// A point of a spectrum that is linear between its points and 0 outside them.
struct SpectralValue {
  double wavelength; ///< nm; increasing from point to point
  double value;
};

/// As Mitsuba 0.x does, lets a spectrum that ends above 0 fall to 0 within the mean distance of its points.
void extend_to_zero(std::vector<SpectralValue>& spectrum);

/// The light under which a spectrum is seen: `equal` energy at every wavelength, for emission; or D65, in
/// which a constant spectrum is grey.
enum class Illuminant { equal, d65 };

/// What the conversion may be off, for messages.
inline constexpr const char* spectrum_error =
    "within 0.01 for reflectances, and within 2% of the largest channel for black bodies from 1500 K on";

/// The colour of a spectrum, by Wyman, Sloan and Shirley's analytic fit of the colour matching functions
/// ("Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2 (2), 2013), scaled so
/// that a constant spectrum has the exact colour of the illuminant. Channels of colours outside the gamut of
/// sRGB are negative. A constant spectrum of 1 has luminance 1, as in Mitsuba.
[[nodiscard]] scene::Rgb color_of(const std::vector<SpectralValue>& spectrum, Illuminant illuminant);

/// The colour of CIE XYZ tristimulus values.
[[nodiscard]] scene::Rgb color_of_xyz(const scene::Vec3& xyz);

/// Planck's radiance at `kelvin` > 0, W / (m^2 sr nm), from 360 to 830 nm.
[[nodiscard]] std::vector<SpectralValue> black_body(double kelvin);

} // namespace phlux::scene_file
