// The error of float32 images, from pairs of renders with the same seeds in float32 and float64.
#pragma once

#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "film/film.h"

namespace phlux::bench {

/// Samples per pixel whose standard error is the unit of the errors of float32.
inline constexpr double unit_samples = 4096;

/// Pairs of renders of one scene; pair i has the same seed in both precisions. Three pairs or more, with
/// equally many samples.
struct PrecisionPairs {
  std::vector<ImageEstimate> float32, float64;
  std::vector<double> variance; ///< of the mean of all float64 renders, for each value, from their films
};

[[nodiscard]] PrecisionPairs pairs_of(const std::vector<film::Film>& float32,
                                      const std::vector<film::Film>& float64);

/// How renders in float32 differ from those in float64. difference and systematic are root mean squares over
/// pixels and channels in the measure of files::compare, divided by the noise: the root of the relative
/// variance of an image of unit_samples samples per pixel.
struct PrecisionError {
  double variance = 0;   ///< relative, of one sample
  double difference = 0; ///< of two images of unit_samples samples and one seed: the systematic part, and
                         ///< samples that rounding sent along another path
  double systematic = 0,
         systematic_most = 0;  ///< part that more samples do not reduce; plus 2 standard errors
  Estimate mean;               ///< relative difference of the means of the images
  double largest = 0;          ///< largest error of a value in its own standard error at unit_samples
  double quiet_share = 0;      ///< share of the values without noise: relative standard error below 1e-6
  double quiet_difference = 0; ///< largest relative difference among those
};

[[nodiscard]] PrecisionError precision_error(const PrecisionPairs& pairs);

/// Samples per pixel in float64 from which on float64 has less error than float32 for the same time, if
/// float32 is `times_as_fast`. Infinite without systematic error, 0 if float32 is not faster.
[[nodiscard]] double break_even_samples(double systematic, double times_as_fast);

} // namespace phlux::bench
