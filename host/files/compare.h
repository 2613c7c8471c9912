// How far two images of the same scene are apart.
#pragma once

#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "files/image.h"

namespace phlux::files {

/// Figures over R, G, B of the pixels that are finite in both images; b is the reference. NaN where nothing
/// is left.
struct Comparison {
  double mean_a = 0.0, mean_b = 0.0; ///< over pixels and channels
  double mean_ratio = 0.0;           ///< mean_a / mean_b
  double rmse = 0.0;                 ///< root of the mean of (a-b)^2
  double relmse = 0.0;               ///< mean of (a-b)^2 / (b^2 + 1e-4)
  double relmse_trimmed =
      0.0; ///< without the largest 0.1% of pixels (rounded down), by their mean over channels

  /// Where both images have variance channels: z = |a-b| / sqrt(variance_a + variance_b + r^2), its largest
  /// value and the share of pixels' channels above 3. The rounding r = 2^-16 max(|a|, |b|) of float32 sums
  /// of up to 256 samples keeps z finite, and small, where there is no noise.
  std::optional<double> max_z, z_share_over_3;

  std::uint64_t nonfinite = 0; ///< values, in the channels above, that are NaN or infinite
};

/// @throws FileError for different sizes or a missing channel, naming the images by `name_a` and `name_b`
[[nodiscard]] Comparison compare(const Image& a, const Image& b, const std::string& name_a,
                                 const std::string& name_b);

/// The fields of Comparison by their names; absent figures are left out, NaN becomes null.
[[nodiscard]] nlohmann::ordered_json to_json(const Comparison& comparison);

} // namespace phlux::files
