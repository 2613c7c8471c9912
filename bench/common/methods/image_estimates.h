// Variance, bias and tail of an estimator from repeated renders with different seeds. Errors are relative to
// a reference image, in the measure of files::compare: squared error / (reference^2 + 1e-4), averaged over
// pixels and channels. An image with n samples per pixel has the expected relative MSE
// (variance per sample) / n. Variance per sample times seconds per sample is the time to unit variance of a
// pixel, the inverse of the efficiency (Veach 1997, chapter 2).
//
// Only means of independent renders are used, so the estimates also hold where the samples of one render are
// correlated. Standard errors are jackknifed over the repeats (Efron and Stein 1981). With R repeats,
// value +- t standard errors is a confidence interval of Student's t distribution with R - 1 degrees of
// freedom.
#pragma once

#include <span>
#include <vector>

#include "film/film.h"

namespace phlux::bench {

/// The image of one render.
struct ImageEstimate {
  std::vector<double> radiance; ///< three values per pixel
  std::vector<double> samples;  ///< of each pixel
};

struct Estimate {
  double value = 0, standard_error = 0;
};

using Reference = std::vector<double>; ///< radiance, three values per pixel
using Repeats = std::span<const ImageEstimate>;

[[nodiscard]] ImageEstimate estimate_of(const film::Film& film);

/// The mean of the repeats; the pixels of each image are weighted by their samples.
[[nodiscard]] ImageEstimate pooled(Repeats repeats);

[[nodiscard]] double relative_mse(const ImageEstimate& image, const Reference& reference);

/// Relative variance per sample: variance of the repeats about their mean, times their samples. Requires two
/// repeats or more.
[[nodiscard]] Estimate variance_per_sample(Repeats repeats, const Reference& reference);

/// Mean radiance over pixels and channels. Requires two repeats or more.
[[nodiscard]] Estimate image_mean(Repeats repeats);

/// The relative MSE of the pooled image minus the part that its variance explains. What remains is squared
/// bias, or the error of the reference. Requires two repeats or more. Without bias the jackknife of this
/// difference of squares overestimates the standard error.
[[nodiscard]] Estimate unexplained_mse(Repeats repeats, const Reference& reference);

/// From images with one sample per pixel: the share of the largest 0.1% of the pixels in the sum of all
/// relative squared errors. 0.006 for normally distributed channels. Near 1 the variance is dominated by a
/// few samples and may be infinite.
[[nodiscard]] double top_share(Repeats one_sample_images, const Reference& reference);

/// log(variance per sample estimated from `many` / from `few`), for repeats with more and with fewer samples.
/// Near 0 for a finite variance whose largest samples were drawn; an infinite variance grows with the number
/// of samples.
[[nodiscard]] Estimate log_growth(Repeats many, Repeats few, const Reference& reference);

/// Two-sided p-value of the hypothesis value = expected, by Student's t distribution with repeats - 1 degrees
/// of freedom. With a standard error of 0: 1 if the value is as expected, else 0.
[[nodiscard]] double p_value(const Estimate& figure, double expected, std::size_t repeats);

} // namespace phlux::bench
