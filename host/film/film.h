// The image in the making: per pixel, float64 sums of radiance and of its square. Knows no device and no
// file.
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

/// Sums stay exact to about 2^-53 times the number of blocks, so that no sample count stalls them (MATH.md
/// 6). What the float32 blocks themselves round remains: with B samples a block, a mean is good to 2^-24 B of
/// itself (2^-24 sqrt(B) where samples differ), and a variance of one sample below that part of mean^2 is
/// rounding, not noise. Squares fit float32 where radiances are between about 1e-18 and 1e18 of the unit.
class Film {
public:
  /// Black, without samples. Both sizes > 0.
  Film(int width, int height);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Row by row from the top; sums are in units, see set_unit().
  [[nodiscard]] std::span<const Pixel> pixels() const { return pixels_; }
  [[nodiscard]] std::span<Pixel> pixels() { return pixels_; }

  /// The radiance that stands as 1 in the sums that devices hand over; 1 unless set. Means and variances are
  /// radiances whatever it is.
  void set_unit(double radiance) { unit_ = radiance; }

  /// Folds one block of `samples` samples of one pixel in. Blocks must come in the same order for the same
  /// bits.
  void add(std::size_t pixel, const BlockSum& block, std::uint32_t samples);

  /// Mean radiance of a pixel; 0 without samples.
  [[nodiscard]] std::array<double, 3> mean(std::size_t pixel) const;
  /// Unbiased variance of that mean, per channel; 0 with fewer than two samples. Never negative.
  [[nodiscard]] std::array<double, 3> variance_of_mean(std::size_t pixel) const;
  /// Whether every pixel has the two samples that a variance takes.
  [[nodiscard]] bool has_variance() const;

  /// Mean over the pixels (and channels) of variance of one sample / mean^2, over pixels that are not black;
  /// 0 where no pixel has two samples and a mean above 0.
  [[nodiscard]] double relative_variance() const;
  /// Mean over the pixels (and channels) of standard error / mean, over pixels that are not black. Infinite
  /// before every pixel has two samples, 0 for an image that is black.
  [[nodiscard]] double relative_standard_error() const;
  [[nodiscard]] double samples_per_pixel() const; ///< mean over the pixels

private:
  int width_, height_;
  double unit_ = 1.0;
  std::vector<Pixel> pixels_;
};

} // namespace phlux::film
