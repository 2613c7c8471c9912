// Error metrics between two images of the same scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "files/image.h"

namespace phlux::files {

/// Added to b^2, which is 0 in black pixels, where differences are relative to b.
inline constexpr double relmse_offset = 1e-4;

/// Over R, G, B of the pixels that are finite in both images; b is the reference. NaN if there are none.
struct Comparison {
  double mean_a = 0.0, mean_b = 0.0;                ///< over pixels and channels
  std::array<double, 3> mean_a_rgb{}, mean_b_rgb{}; ///< over pixels
  double mean_ratio = 0.0;                          ///< mean_a / mean_b
  double mean_error = 0.0;                          ///< |mean_ratio - 1|
  double rmse = 0.0;                                ///< root of the mean of (a-b)^2
  double relmse = 0.0;                              ///< mean of (a-b)^2 / (b^2 + 1e-4)
  double relmse_trimmed = 0.0; ///< without the 0.1% of pixels of largest error (rounded down)
  /// Peak signal-to-noise ratio in decibels, -10 log10 of the mean squared difference of the values that a
  /// screen shows: both images exposed as b is, tone-mapped (tone_map.h) and encoded as sRGB, from 0 to the
  /// peak, 1. Infinite without a difference.
  double psnr = 0.0;

  /// If both images have variance channels: z = |a-b| / sqrt(variance_a + variance_b + r^2), its largest
  /// value and the share of values above 3. r = 2^-16 max(|a|, |b|) bounds the rounding of float32 sums of up
  /// to 256 samples; without noise it keeps z finite and small.
  std::optional<double> max_z, z_share_over_3;

  std::uint64_t nonfinite = 0; ///< values, in the channels above, that are NaN or infinite
};

/// @throws FileError for different sizes or a missing channel, naming the images by `name_a` and `name_b`
[[nodiscard]] Comparison compare(const Image& a, const Image& b, const std::string& name_a,
                                 const std::string& name_b);

/// The members of Comparison of which a larger one is worse.
inline constexpr std::array metric_names = {"mean_error", "rmse",           "relmse",   "relmse_trimmed",
                                            "max_z",      "z_share_over_3", "nonfinite"};

/// The members of Comparison by their names; absent ones are left out. In text, NaN and infinity are null.
[[nodiscard]] nlohmann::ordered_json to_json(const Comparison& comparison);

} // namespace phlux::files
