// The reliability of a film's error estimate. A variance that a few samples dominate is likely to be
// underestimated, as rarer and larger contributions have not been sampled yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/film.h"

namespace phlux::film {

/// Per pixel; with fewer, no error estimate is trusted.
inline constexpr double least_samples = 16.0;
/// Largest relative underestimate of a trusted standard error.
inline constexpr double most_understated = 0.1;

struct Reliability {
  bool trusted = false;
  std::vector<std::string> reasons; ///< why it is not trusted
  /// Variance of one sample per pixel, relative to the squared mean radiance of the pixel or of its tile of
  /// 16x16 pixels, whichever is larger; the mean over the image.
  double variance = 0.0;
  /// Relative standard error of that variance.
  double variance_error = 0.0;
  /// Likely relative underestimate of pixels' standard errors, and so of the relative standard error, in [0,
  /// 1]: the root of an unbiased variance estimate with relative variance r is too small by r / 8.
  double understated = 0.0;
  /// Share of the largest 0.1% of the samples in the variance; an upper bound for samples in blocks.
  double top_share = 0.0;
  /// Index a of the tail of contributions, P(contribution > x) ~ x^-a. The variance is infinite for a <= 2,
  /// the variance of its estimate for a <= 4. Nothing with too few contributions.
  std::optional<double> tail_index;
  /// The largest contribution to the variance grew as samples^growth over the last two doublings of samples;
  /// for growth >= 1 the variance does not converge.
  std::optional<double> growth;
  /// Centre of the tile with the largest share in the variance, in pixels from the top left, and that share.
  int worst_x = 0, worst_y = 0;
  double worst_share = 0.0;
};

[[nodiscard]] Reliability reliability_of(const Film& film);

/// Per pixel, constant over each tile: 1 - relative standard error of a pixel's variance, in [0, 1]; 0 in
/// black tiles.
[[nodiscard]] std::vector<float> reliability_map(const Film& film);

} // namespace phlux::film
