// Statistical tests that two images agree up to noise, in every channel of every pixel, with a stated
// false-alarm rate.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "film/film.h"

namespace phlux::test {

/// Probability that a comparison of two images with the same expectation fails. Seeds are fixed, so a
/// comparison that passes once passes on that device as long as the renderer draws the same numbers.
inline constexpr double false_alarm_rate = 1e-4;

/// Bound on the relative error of float32 sums of a block of samples and of the arithmetic of a path.
inline constexpr double rounding = 2e-5;

using Channels = std::array<double, 3>;

/// Means of the values of an image, and the variance of each mean (0 for a closed form).
struct Estimate {
  int width = 0, height = 0;
  std::vector<Channels> mean, variance; ///< row by row from the top
};

[[nodiscard]] Estimate estimate_of(const film::Film& film);
/// Exact values of the pixels.
[[nodiscard]] Estimate closed_form(int width, int height, std::vector<Channels> mean);
[[nodiscard]] Estimate uniform(const film::Film& size_of, const Channels& mean);

/// Means over square tiles of pixels. A tile has more of the rare bright samples than a pixel, so its mean is
/// closer to normal.
[[nodiscard]] Estimate tiles(const Estimate& image, int side);

struct Agreement {
  bool agrees = false;
  std::string message; ///< the worst pixel: where, both values, z, its p-value and what it must exceed
};

/// Two-sided z-tests of each channel of each pixel and of each channel's mean over the image, with Sidak's
/// correction: together they raise a false alarm with probability false_alarm_rate if the pixels are
/// independent and normal (less if they are correlated). Differences up to `tolerance` of the larger value
/// count as rounding.
[[nodiscard]] Agreement agreement(const Estimate& image, const Estimate& reference,
                                  double tolerance = rounding);

/// agreement() without the tests of the mean of the image.
[[nodiscard]] Agreement agreement_of_pixels(const Estimate& image, const Estimate& reference,
                                            double tolerance = rounding);

/// p-values of the tests of pixels, channel by channel, uncorrected.
[[nodiscard]] std::vector<Channels> p_of_pixels(const Estimate& image, const Estimate& reference,
                                                double tolerance = rounding);

} // namespace phlux::test
