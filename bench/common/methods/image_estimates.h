// Variance, bias and tail of an estimator from repeated renders with different seeds. Errors are relative to
// a reference image, in the measure of files::compare: squared error / (reference^2 + 1e-4), averaged over
// pixels and channels. An image with n samples per pixel has the expected relative MSE
// (variance per sample) / n. Variance per sample times seconds per sample is the time to unit variance of a
// pixel, the inverse of the efficiency (Veach 1997, chapter 2).
//
// Only means of independent renders are used, so the estimates also hold where the samples of one render are
// correlated. Vectors of radiance, variance and weights have three values per pixel.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "film/film.h"

namespace phlux::bench {

/// The image of one render.
struct ImageEstimate {
  std::vector<double> radiance;
  std::vector<double> samples; ///< one value per pixel
};

/// A value with its standard error, from a t distribution with `degrees` degrees of freedom.
struct Estimate {
  double value = 0, standard_error = 0;
  double degrees = std::numeric_limits<double>::infinity();
};

using Repeats = std::span<const ImageEstimate>;

/// The image from which errors are measured. A squared error has the weight 1 / (radiance^2 + 1e-4).
struct Reference {
  std::vector<double> radiance;
  std::vector<double> variance; ///< of the radiance; 0 where it is exact
  std::vector<double> weights;

  /// The expected relative MSE of the reference itself.
  [[nodiscard]] double relmse() const;
};

/// A reference without error.
[[nodiscard]] Reference exact_reference(std::vector<double> radiance);

/// A reference with noise, of an image of this width. Its weights are those of the denoised image: by its own
/// value, a pixel that is too bright by chance would lower the weight of its error. Denoised by the local
/// linear minimum mean square error filter (Lee 1980) over 9x9 pixels.
[[nodiscard]] Reference noisy_reference(std::vector<double> radiance, std::vector<double> variance,
                                        std::size_t width);

/// The mean of the repeats, as a reference with its own variance. Requires two repeats or more.
[[nodiscard]] Reference pooled_reference(Repeats repeats, std::size_t width);

[[nodiscard]] ImageEstimate estimate_of(const film::Film& film);

/// The mean of the repeats; the pixels of each image are weighted by their samples.
[[nodiscard]] ImageEstimate pooled(Repeats repeats);

[[nodiscard]] double relative_mse(const ImageEstimate& image, const Reference& reference);

/// Mean of the values with its standard error, from values.size() - 1 degrees of freedom. With one value the
/// standard error is infinite.
[[nodiscard]] Estimate mean_of(std::span<const double> values);

/// Relative variance per sample by each repeat: its squared distance from the mean of all repeats, times its
/// samples, times R / (R - 1) for R repeats. The mean of these values is the unbiased estimate. Requires two
/// repeats or more.
[[nodiscard]] std::vector<double> variances_per_sample(Repeats repeats, const Reference& reference);

/// The same for the covariance of two estimates of each pixel from the same renders, such as one technique
/// and the sum of all.
[[nodiscard]] std::vector<double> covariances_per_sample(Repeats a, Repeats b, const Reference& reference);

/// Mean of a / mean of b, of figures from the same rounds, with a standard error by the jackknife over the
/// rounds. Requires two rounds or more, and means of b that are not 0.
[[nodiscard]] Estimate ratio_of(std::span<const double> a, std::span<const double> b);

/// The logarithm of the geometric mean of independent ratios, such as those of several scenes, with the
/// degrees of freedom of one of them, which is on the safe side.
[[nodiscard]] Estimate mean_log_of(std::span<const Estimate> ratios);

/// Such a mean and its 95% interval: "0.931 (95%: 0.92 to 0.95)".
[[nodiscard]] std::string text_of_mean_log(const Estimate& mean);

/// Mean radiance over pixels and channels of each repeat.
[[nodiscard]] std::vector<double> image_means(Repeats repeats);

/// The relative squared error of the pooled image, minus the parts that the variances of the image and of the
/// reference explain: squared bias. The standard error is that of the mean over groups of pixels, so it holds
/// for any distribution of the radiance. Requires two repeats or more.
[[nodiscard]] Estimate unexplained_mse(Repeats repeats, const Reference& reference);

/// From images with one sample per pixel: the share of the largest 0.1% of the pixels in the sum of all
/// relative squared errors. 0.006 for normally distributed channels. Near 1 the variance is dominated by a
/// few samples and may be infinite.
[[nodiscard]] double top_share(Repeats one_sample_images, const Reference& reference);

/// log(mean of `many` / mean of `few`), of the variances per sample by repeats with more and with fewer
/// samples. Near 0 for a finite variance whose largest samples were drawn; an infinite variance grows with
/// the number of samples. 0 if a mean is 0.
[[nodiscard]] Estimate log_growth(std::span<const double> many, std::span<const double> few);

/// a - b of independent estimates, with Welch's degrees of freedom.
[[nodiscard]] Estimate difference_of(const Estimate& a, const Estimate& b);

/// p-values of the hypothesis value = expected, two-sided, and of value <= expected, one-sided. With a
/// standard error of 0: 1 if the hypothesis is true of the value, else 0. With an infinite one: 1.
[[nodiscard]] double p_value(const Estimate& figure, double expected);
[[nodiscard]] double p_value_above(const Estimate& figure, double expected);

} // namespace phlux::bench
