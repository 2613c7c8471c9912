// What repeats of a render with different seeds say of its estimator. Everything is relative to a reference
// image in the measure of files::compare: squared error / (reference^2 + 1e-4), its mean over pixels and
// channels. So an image with n samples per pixel has an expected relative MSE of (variance per sample) / n,
// and the variance times the seconds of a sample is the time to unit variance of a pixel.
//
// Only means over independent renders are used, which is right for every integrator, whatever its samples
// share. Standard errors are jackknifed over the repeats (Efron and Stein 1981): with R repeats, value +- t
// standard errors covers the truth as Student's t with R - 1 degrees of freedom says.
#pragma once

#include <span>
#include <vector>

#include "film/film.h"

namespace phlux::bench {

/// One render.
struct ImageEstimate {
  std::vector<double> radiance; ///< three a pixel
  std::vector<double> samples;  ///< of each pixel
};

struct Figure {
  double value = 0, standard_error = 0;
};

using Reference = std::vector<double>; ///< radiance, three a pixel
using Repeats = std::span<const ImageEstimate>;

[[nodiscard]] ImageEstimate estimate_of(const film::Film& film);

/// The mean of the repeats, each pixel weighted by its samples.
[[nodiscard]] ImageEstimate pooled(Repeats repeats);

[[nodiscard]] double relative_mse(const ImageEstimate& image, const Reference& reference);

/// Relative variance of one sample per pixel: that of the repeats about their own mean, times their samples.
/// At least two repeats.
[[nodiscard]] Figure variance_per_sample(Repeats repeats, const Reference& reference);

/// Mean radiance of the image over pixels and channels. At least two repeats.
[[nodiscard]] Figure image_mean(Repeats repeats);

/// The part of the pooled image's relative MSE that its variance does not explain: squared bias, or the
/// reference's own error. At least two repeats. Without a bias the standard error is too large: the jackknife
/// of a difference of squares is careful there.
[[nodiscard]] Figure unexplained_mse(Repeats repeats, const Reference& reference);

/// Of images with one sample per pixel: the share that the largest thousandth of the pixels holds in the sum
/// of all relative squared errors. 0.011 for a normal distribution; near 1 a variance rests on a few samples,
/// and may be infinite.
[[nodiscard]] double top_share(Repeats one_sample_images, const Reference& reference);

/// Logarithm of (variance per sample from `many`) / (from `few`), two sets of repeats with more and with
/// fewer samples: near 0 where the variance exists and was met; an infinite one grows with what was sampled.
[[nodiscard]] Figure log_growth(Repeats many, Repeats few, const Reference& reference);

/// Two-sided p-value of value = expected under Student's t for so many repeats; 1 where the standard error is
/// 0 and the value as expected.
[[nodiscard]] double p_value(const Figure& figure, double expected, std::size_t repeats);

} // namespace phlux::bench
