// Whether a film's own error estimate can be believed. A variance is estimated from the samples that there
// were; where few of them make the most of it, the largest that there can be are still to come.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/film.h"

namespace phlux::film {

/// Per pixel: fewer tell nothing of what is rare.
inline constexpr double least_samples = 16.0;
/// Part of standard errors that may be missing where they are trusted.
inline constexpr double most_understated = 0.1;

struct Reliability {
  bool trusted = false;
  std::vector<std::string> reasons; ///< why not, in words
  /// Of one sample per pixel, relative to the squared mean radiance of the pixel or of the 16x16 pixels
  /// around, whichever is more; the mean over the image.
  double variance = 0.0;
  /// Relative standard error of that variance.
  double variance_error = 0.0;
  /// How far pixels' standard errors, and so the relative standard error, are likely to be too small: the
  /// root of an unbiased variance with relative variance r is too small by r / 8. In [0, 1].
  double understated = 0.0;
  /// Share of the largest 0.1% of the samples in the variance. Of samples that begin in a pixel an upper
  /// bound: they come in blocks.
  double top_share = 0.0;
  /// Index a of the tail of contributions, P(contribution > x) ~ x^-a: at 2 and below the variance is
  /// infinite, at 4 and below that of its estimate. Nothing where there are too few to tell.
  std::optional<double> tail_index;
  /// How the largest contribution to the variance grew over the last two doublings: as samples^growth; 1 and
  /// above: the variance does not settle.
  std::optional<double> growth;
  /// Centre of the tile with the largest share in the variance, in pixels from the top left, and that share.
  int worst_x = 0, worst_y = 0;
  double worst_share = 0.0;
};

[[nodiscard]] Reliability reliability_of(const Film& film);

/// Per pixel, the same for each tile: 1 - relative standard error of a pixel's variance, in [0, 1]; 0 where
/// no light arrived.
[[nodiscard]] std::vector<float> reliability_map(const Film& film);

} // namespace phlux::film
