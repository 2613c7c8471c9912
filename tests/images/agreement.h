// Do two images agree but for noise? Tests of every channel of every pixel, with a false-alarm rate that is
// stated.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "film/film.h"

namespace phlux::test {

/// Chance that one comparison of two images with the same expectation fails. Seeds are fixed, so a comparison
/// that passes once passes on that device for as long as the renderer draws the same numbers.
inline constexpr double false_alarm_rate = 1e-4;

/// Float32 sums of a block of samples and the arithmetic of a path are good to this part of a value at least.
inline constexpr double rounding = 2e-5;

using Channels = std::array<double, 3>;

/// What is known of an image: means, and the variance of each (0 for a closed form).
struct Estimate {
  int width = 0, height = 0;
  std::vector<Channels> mean, variance; ///< row by row from the top
};

[[nodiscard]] Estimate estimate_of(const film::Film& film);
/// Each pixel's value known exactly.
[[nodiscard]] Estimate closed_form(int width, int height, std::vector<Channels> mean);
[[nodiscard]] Estimate uniform(const film::Film& size_of, const Channels& mean);

/// Means over square tiles of pixels: rare bright samples are many enough in a tile for its mean to be
/// normal.
[[nodiscard]] Estimate tiles(const Estimate& image, int side);

struct Agreement {
  bool agrees = false;
  std::string message; ///< the worst pixel: where, both values, z, its p-value and what it must exceed
};

/// Two-sided z-tests of each channel of each pixel and of each channel's mean over the image, corrected after
/// Sidak, so that all of them together raise a false alarm with false_alarm_rate where the pixels are
/// independent and normal (less often where they are correlated). Differences up to `tolerance` of the larger
/// value are rounding.
[[nodiscard]] Agreement agreement(const Estimate& image, const Estimate& reference,
                                  double tolerance = rounding);

/// The same without the tests of the image's mean.
[[nodiscard]] Agreement agreement_of_pixels(const Estimate& image, const Estimate& reference,
                                            double tolerance = rounding);

/// Of the tests of pixels, channel by channel, each as if it were the only one.
[[nodiscard]] std::vector<Channels> p_of_pixels(const Estimate& image, const Estimate& reference,
                                                double tolerance = rounding);

} // namespace phlux::test
