// The reliability of a film's error estimate. If a few samples dominate a variance, it is underestimated,
// because rarer and larger contributions have not been sampled yet. Then the 95% interval of a pixel, mean
// +- 1.96 standard errors, contains the true value in less than 95% of the cases.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"

namespace phlux::film {

/// Per pixel; with fewer, no error estimate is trusted.
inline constexpr double least_samples = 8.0;
/// Coverage of the intervals if errors are normal.
inline constexpr double nominal_coverage = 0.95;
/// The least coverage of a trusted image. Of the renders of tests/images/coverage_table.cpp it rejects 2% of
/// those with a true coverage of 93% to 97%, and 96% of those below 85%.
inline constexpr double least_coverage = 0.865;

/// Largest Reliability::variance_error of a trusted image: eleven samples cause the whole variance.
inline constexpr double largest_variance_error = 0.3;

struct Reliability {
  bool trusted = false;
  std::vector<std::string> reasons; ///< why it is not trusted
  /// Coverage: share of the pixels whose 95% intervals contain the true value, as predicted from the film.
  double coverage = 0.0;
  /// Estimate of Film::relative_standard_error() if every pixel of a tile had received the same amount of
  /// rare, bright light.
  double relative_standard_error = 0.0;
  /// Variance of one sample per pixel, relative to the squared mean radiance of the pixel or of its tile of
  /// 16x16 pixels, whichever is larger; the mean over the image.
  double variance = 0.0;
  /// Relative standard error of that variance.
  double variance_error = 0.0;
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

[[nodiscard]] Reliability reliability_of(const Film& film, const Progress& progress = {});

/// The values of reliability_map(), each computed when it is requested. The film must not change.
class ReliabilityMap {
public:
  explicit ReliabilityMap(const Film& film, const Progress& progress = {});
  ~ReliabilityMap();
  [[nodiscard]] float operator[](std::size_t pixel) const;

private:
  std::unique_ptr<const class Tiles> tiles_;
};

/// Per pixel: the predicted probability that its 95% interval contains the true value; 0 in black pixels.
[[nodiscard]] std::vector<float> reliability_map(const Film& film);

} // namespace phlux::film
