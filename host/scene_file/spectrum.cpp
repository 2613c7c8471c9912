#include "scene_file/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/mat3x3.hpp>

namespace phlux::scene_file {

namespace {

using scene::Rgb;
using scene::Vec3;

constexpr int shortest = 360, longest = 830; ///< nm, of the CIE's tables

/// Relative spectral power of D65 every 10 nm from 360 nm on (CIE 15, table T.1).
constexpr std::array<double, 48> d65_power = {
    46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008,
    117.812, 114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
    100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
    80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927,
    46.4182, 66.8054, 63.3828, 64.3040, 59.4519, 51.9590, 57.4406, 60.3125};
constexpr Vec3 d65_white(0.95047, 1.0, 1.08883), equal_white(1.0); ///< XYZ

double lobe(double wavelength, double height, double center, double width_below, double width_above) {
  const double t = (wavelength - center) / (wavelength < center ? width_below : width_above);
  return height * std::exp(-0.5 * t * t);
}

/// The CIE 1931 colour matching functions (Wyman, Sloan and Shirley 2013, table 1: multi-lobe fit).
Vec3 matching_functions(double w) {
  return {lobe(w, 0.362, 442.0, 16.0, 26.7) + lobe(w, 1.056, 599.8, 37.9, 31.0) +
              lobe(w, -0.065, 501.1, 20.4, 26.2),
          lobe(w, 0.821, 568.8, 46.9, 40.5) + lobe(w, 0.286, 530.9, 16.3, 31.1),
          lobe(w, 1.217, 437.0, 11.8, 36.0) + lobe(w, 0.681, 459.0, 26.0, 13.8)};
}

double power_of(Illuminant illuminant, int wavelength) {
  if (illuminant == Illuminant::equal) return 1.0;
  const auto index = static_cast<std::size_t>((wavelength - shortest) / 10);
  const double next = d65_power[std::min(index + 1, d65_power.size() - 1)];
  return std::lerp(d65_power[index], next, (wavelength - shortest) % 10 / 10.0);
}

double value_at(const std::vector<SpectralValue>& spectrum, double wavelength) {
  const auto after = std::ranges::lower_bound(spectrum, wavelength, {}, &SpectralValue::wavelength);
  if (after == spectrum.end()) return 0.0;
  if (after == spectrum.begin()) return after->wavelength == wavelength ? after->value : 0.0;
  const auto before = std::prev(after);
  const double t = (wavelength - before->wavelength) / (after->wavelength - before->wavelength);
  return std::lerp(before->value, after->value, t);
}

} // namespace

void extend_to_zero(std::vector<SpectralValue>& spectrum) {
  if (spectrum.size() < 2) return;
  const SpectralValue first = spectrum.front(), last = spectrum.back();
  const double spacing = (last.wavelength - first.wavelength) / static_cast<double>(spectrum.size() - 1);
  if (first.value != 0.0) spectrum.insert(spectrum.begin(), {first.wavelength - spacing, 0.0});
  if (last.value != 0.0) spectrum.push_back({last.wavelength + spacing, 0.0});
}

scene::Rgb color_of_xyz(const Vec3& xyz) {
  // IEC 61966-2-1, from the chromaticities of its primaries; by columns.
  constexpr glm::dmat3 to_rgb(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
                              0.0415560, 1.0572252);
  return to_rgb * xyz;
}

scene::Rgb color_of(const std::vector<SpectralValue>& spectrum, Illuminant illuminant) {
  Vec3 sum(0.0), white(0.0);
  for (int wavelength = shortest; wavelength <= longest; ++wavelength) {
    const Vec3 weight = matching_functions(wavelength) * power_of(illuminant, wavelength);
    sum += weight * value_at(spectrum, wavelength);
    white += weight;
  }
  return color_of_xyz(sum / white * (illuminant == Illuminant::d65 ? d65_white : equal_white));
}

std::vector<SpectralValue> black_body(double kelvin) {
  constexpr double c = 299792458.0, h = 6.62607015e-34, k = 1.380649e-23; // SI
  std::vector<SpectralValue> spectrum;
  for (int wavelength = shortest; wavelength <= longest; ++wavelength) {
    const double metres = wavelength * 1e-9;
    const double per_metre =
        2.0 * h * c * c / std::pow(metres, 5.0) / std::expm1(h * c / (metres * k * kelvin));
    spectrum.push_back({static_cast<double>(wavelength), per_metre * 1e-9});
  }
  return spectrum;
}

} // namespace phlux::scene_file
