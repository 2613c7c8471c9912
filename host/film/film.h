// The image in the making: per pixel, float64 sums of radiance and of its square. Knows no device and no
// file.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "film/evidence.h"
#include "film/techniques.h"

namespace phlux::film {

/// What a device hands over for one pixel and one block of samples: float32 sums over `samples` samples.
struct BlockSum {
  float radiance[3];
  float radiance_squared[3];
  float nonfinite = 0.0F; ///< contributions that were not finite, and are not in the sums
  float clamped = 0.0F;   ///< sum over channels of the radiance that clamping took away
};

/// Sums over the samples that began in a pixel.
struct Pixel {
  std::array<double, 3> sum{}, sum_of_squares{};
  double sum_of_fourths = 0.0; ///< of blocks: of the square of what one adds to the sum of squared deviations
  std::uint64_t samples = 0;

  template<class Archive>
  void serialize(Archive& archive) {
    archive(sum, sum_of_squares, sum_of_fourths, samples);
  }
};

/// Sums over what paths that began elsewhere brought to a pixel; each square is of what one path brought.
/// One cache line, as splats fall where they like.
struct alignas(64) Splats {
  std::array<double, 3> sum{}, sum_of_squares{};
  double sum_of_fourths = 0.0; ///< of the squared sum over channels of the squares

  template<class Archive>
  void serialize(Archive& archive) {
    archive(sum, sum_of_squares, sum_of_fourths);
  }
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
  [[nodiscard]] double unit() const { return unit_; }

  /// Folds one block of `samples` samples of one pixel in. Blocks must come in the same order for the same
  /// bits.
  void add(std::size_t pixel, const BlockSum& block, std::uint32_t samples);

  /// No path brings a pixel more than `radiance` in any channel from here on: a bias. What splats bring is
  /// clamped here, what blocks bring by the device.
  void set_clamp(double radiance) { clamp_ = radiance / unit_; }
  /// Share of the light that clamping took away.
  [[nodiscard]] double clamped_share() const;

  /// Adds what one path brought to a pixel that it did not begin in. A pixel's radiance is the mean of its
  /// samples plus the sum of its splats / the number of splatting paths per pixel of the image. Sizes are
  /// taken of one splat in `sized_one_in` alone: of each they would cost a sixth of light tracing's time.
  void add_splat(std::size_t pixel, std::array<double, 3> value, bool sized = true) {
    if (clamp_) clamp(value);
    Splats& sums = splats_[pixel];
    double square = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      sums.sum[channel] += value[channel];
      const double channel_square = value[channel] * value[channel];
      sums.sum_of_squares[channel] += channel_square;
      square += channel_square;
    }
    sums.sum_of_fourths += square * square;
    if (sized) count_splat(pixel, square, value[0] + value[1] + value[2]);
  }
  static constexpr std::uint32_t sized_one_in = 16;
  void use_splats() { splats_.resize(pixels_.size()); } ///< before the first add_splat()
  /// Fetches what add_splat() will need soon.
  void expect_splat(std::size_t pixel) const { __builtin_prefetch(&splats_[pixel], 1); }
  /// Counts paths of the whole image that may bring splats, before they do.
  void add_splatting_paths(std::uint64_t paths);
  [[nodiscard]] bool splats() const { return !splats_.empty(); }

  /// Keeps what each technique brings by itself as well, from here on.
  void use_techniques() {
    if (!techniques_) techniques_.emplace(pixels_.size());
  }
  [[nodiscard]] Techniques* techniques() { return techniques_ ? &*techniques_ : nullptr; }
  /// One technique's image, of sums of `techniques()`: radiance per pixel.
  [[nodiscard]] std::vector<std::array<double, 3>>
  technique_image(const std::vector<std::array<double, 3>>& sums) const;

  /// Mean radiance of a pixel; 0 without samples.
  [[nodiscard]] std::array<double, 3> mean(std::size_t pixel) const;
  /// Unbiased variance of that mean, per channel; 0 with fewer than two samples. Never negative.
  [[nodiscard]] std::array<double, 3> variance_of_mean(std::size_t pixel) const;
  /// Whether every pixel has the two samples, of its own or of splatting paths, that a variance takes.
  [[nodiscard]] bool has_variance() const;

  /// Mean over the pixels (and channels) of variance of one sample / mean^2, over pixels that are not black;
  /// 0 where no pixel has two samples and a mean above 0.
  [[nodiscard]] double relative_variance() const;
  /// Mean over the pixels (and channels) of standard error / mean, over pixels that are not black. Infinite
  /// before every pixel has two samples, 0 for an image that is black.
  [[nodiscard]] double relative_standard_error() const;
  [[nodiscard]] double samples_per_pixel() const; ///< mean over the pixels

  /// Of all pixels: samples that began in them, or paths that splat where none did.
  [[nodiscard]] std::uint64_t samples() const { return own_samples_ > 0 ? own_samples_ : splatting_paths_; }
  /// Independent sums that the variance is made from: blocks of samples, and paths that splat.
  [[nodiscard]] std::uint64_t contributors() const { return blocks_ + splatting_paths_; }
  [[nodiscard]] const Evidence& evidence() const { return evidence_; }

  /// What is known of a pixel's variance; sums over its channels, in units.
  struct Spread {
    double mean = 0.0;    ///< of the pixel, over channels
    double squares = 0.0; ///< of what contributions differ from the mean: about samples x variance of one
    double fourths = 0.0; ///< of the squares of those
  };
  [[nodiscard]] Spread spread(std::size_t pixel) const;

  /// Hands all that the film holds to an archive that writes, or takes it from one that reads: a film that
  /// has taken what another handed over goes on as that one would, bit for bit.
  template<class Archive>
  void serialize(Archive& archive) {
    archive(width_, height_, unit_, pixels_, splats_, splatting_paths_, own_samples_, blocks_, evidence_,
            clamp_, clamped_, clamped_of_splats_, techniques_);
  }

private:
  void clamp(std::array<double, 3>& value);
  void count_splat(std::size_t pixel, double square, double sum);
  [[nodiscard]] double splatting_paths_per_pixel() const;
  [[nodiscard]] double mean_in_units(std::size_t pixel, std::size_t channel) const;
  [[nodiscard]] double variance_in_units(std::size_t pixel, std::size_t channel) const;
  template<class Function>
  [[nodiscard]] double mean_where_not_black(Function f) const;

  int width_, height_;
  double unit_ = 1.0;
  std::vector<Pixel> pixels_;
  std::vector<Splats> splats_; ///< empty where nothing splats
  std::uint64_t splatting_paths_ = 0, own_samples_ = 0, blocks_ = 0;
  Evidence evidence_;
  std::optional<double> clamp_; ///< in units
  double clamped_ = 0.0;        ///< of blocks, in units, sum over channels
  double clamped_of_splats_ = 0.0;
  std::optional<Techniques> techniques_;
};

} // namespace phlux::film
