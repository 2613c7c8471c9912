// The image in the making: per pixel, float64 sums of radiance and of its square. Knows no device and no file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace phlux::film {

/// What a device hands over for one pixel and one block of samples: float32 sums over `samples` samples.
struct BlockSum {
  float radiance[3];
  float radiance_squared[3];
};

struct Pixel {
  std::array<double, 3> sum{}, sum_of_squares{};
  std::uint64_t samples = 0;
};

class Film {
public:
  Film(int width, int height);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::span<const Pixel> pixels() const { return pixels_; } ///< row by row from the top
  [[nodiscard]] std::span<Pixel> pixels() { return pixels_; }

  /// Folds one block of `samples` samples of one pixel in. Blocks must come in the same order for the same bits.
  void add(std::size_t pixel, const BlockSum& block, std::uint32_t samples);

  /// Mean radiance of a pixel; 0 without samples.
  [[nodiscard]] std::array<double, 3> mean(std::size_t pixel) const;
  /// Unbiased variance of that mean, per channel; 0 with fewer than two samples. Never negative.
  [[nodiscard]] std::array<double, 3> variance_of_mean(std::size_t pixel) const;

  /// Mean over the pixels (and channels) of variance of one sample / mean^2, over pixels that are not black.
  [[nodiscard]] double relative_variance() const;
  /// Mean over the pixels of standard error / mean, over pixels that are not black. Infinite before two samples.
  [[nodiscard]] double relative_standard_error() const;
  [[nodiscard]] double samples_per_pixel() const; ///< mean over the pixels

private:
  int width_, height_;
  std::vector<Pixel> pixels_;
};

} // namespace phlux::film
