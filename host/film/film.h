// The image while it is rendered: per pixel, float64 sums of radiance and of its square. Independent of
// devices and files.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "film/evidence.h"
#include "film/paged_array.h"
#include "film/progress.h"
#include "film/techniques.h"
#include "film/zeroed_memory.h"

namespace phlux::film {

/// A device's float32 sums over a block of samples of one pixel.
struct BlockSum {
  float radiance[3];
  float radiance_squared[3];
  float nonfinite = 0.0F; ///< contributions that were not finite, and are not in the sums
  float clamped = 0.0F;   ///< sum over channels of the radiance that clamping removed
};

/// Sums over the samples of a pixel; new ones are 0.
struct Pixel {
  std::array<double, 3> sum{}, sum_of_squares{};
  double sum_of_fourths = 0.0; ///< over blocks: squared sum over channels of squared deviations
  std::uint64_t samples = 0;

  template<class Archive>
  void serialize(Archive& archive) {
    archive(sum, sum_of_squares, sum_of_fourths, samples);
  }
};

/// Sums over the blocks of a pixel, where samples of a block are not independent.
struct BlockMoments {
  std::array<double, 3> squares{};  ///< of the sums of blocks
  std::array<double, 3> weighted{}; ///< sums of blocks x their numbers of samples
  double squared_samples = 0.0;     ///< of the numbers of samples

  void add(const BlockSum& block, std::uint32_t samples);

  template<class Archive>
  void serialize(Archive& archive) {
    archive(squares, weighted, squared_samples);
  }
};

/// Sums over the splats onto a pixel by paths of other pixels; each square is of the sum of one path's
/// splats. Aligned to a cache line, as splats have no locality.
struct alignas(64) Splats {
  std::array<double, 3> sum{}, sum_of_squares{};
  double sum_of_fourths = 0.0; ///< of the squared sum over channels of the squares

  template<class Archive>
  void serialize(Archive& archive) {
    archive(sum, sum_of_squares, sum_of_fourths);
  }
};

/// The relative rounding error of the sums is at most 2^-53 times the number of blocks, so that they do not
/// stall. The float32 sums of blocks of B samples have a relative error of up to 2^-24 B
/// (2^-24 sqrt(B) where samples differ); a variance of one sample below that part of mean^2 is rounding, not
/// noise. Squares fit float32 for radiances between about 1e-18 and 1e18 units.
class Film {
public:
  /// A black film without samples. Both sizes > 0. `storage` is that of the sums of samples; the sums of
  /// splats, which arrive in no order, are always in memory. With a file, whatever reads or adds sums may
  /// throw WriteError.
  Film(int width, int height, Storage storage = Storage::memory);
  /// Bytes of memory of a film with these numbers of pixels, of sums of samples (0 or 1 per pixel), of splats
  /// (0 or 1), of blocks of dependent samples (0 or 1), and of techniques.
  [[nodiscard]] static double bytes(double pixels, int samples, int splats, int blocks, int techniques) {
    return pixels * (samples * double{sizeof(Pixel)} + splats * double{sizeof(Splats)} +
                     blocks * double{sizeof(BlockMoments)} + techniques * Techniques::bytes_per_pixel);
  }
  /// The same of this film.
  [[nodiscard]] double bytes() const {
    return bytes(static_cast<double>(pixels_.size()), 1, splats() ? 1 : 0, dependent_samples() ? 1 : 0,
                 techniques_ ? static_cast<int>(techniques_->sums().size()) : 0);
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Pixels of a row of tiles of TileMeans.
  [[nodiscard]] std::size_t row_of_tiles() const {
    return static_cast<std::size_t>(width_) * TileMeans::tile_edge;
  }
  /// Row by row from the top; sums are in units, see set_unit().
  [[nodiscard]] auto pixels() const { return Elements(pixels_); }
  [[nodiscard]] auto pixels() { return Elements(pixels_); }

  /// The radiance that is 1 in the devices' sums; 1 by default. mean() and variance_of_mean() are in
  /// radiance.
  void set_unit(double radiance) { unit_ = radiance; }
  [[nodiscard]] double unit() const { return unit_; }

  /// Adds a block of `samples` samples of one pixel. The result depends on the order of blocks, by rounding.
  void add(std::size_t pixel, const BlockSum& block, std::uint32_t samples);

  /// Clamps the contribution of each path to a pixel to at most `radiance` in any channel, which is a bias.
  /// The film clamps splats; the device clamps samples.
  void set_clamp(double radiance) { clamp_ = radiance / unit_; }
  [[nodiscard]] bool clamps() const { return clamp_.has_value(); }
  /// Share of the light that clamping removed.
  [[nodiscard]] double clamped_share() const;

  /// Adds a splat: one path's contribution to a pixel other than its own. A pixel's radiance is the mean of
  /// its samples plus the sum of its splats / the number of splatting paths per pixel of the image. Only one
  /// splat in `sized_one_in` is added to the ContributionSizes: all would take a sixth of light tracing's
  /// time.
  void add_splat(std::size_t pixel, std::array<double, 3> value, bool sized = true) {
    if (clamp_) clamp(value);
    add_splat(pixel, value, sized, evidence_.tally());
  }
  static constexpr std::uint32_t sized_one_in = 16;
  void use_splats() { splats_.resize(pixels_.size()); } ///< before the first add_splat()
  /// Prefetches the pixel for add_splat(). Inlined always: GCC drops calls of a function that only
  /// prefetches.
  [[gnu::always_inline]] void expect_splat(std::size_t pixel) const {
    __builtin_prefetch(&splats_[pixel], 1);
  }
  /// Counts paths of the whole image that may splat; to be called before their splats are added.
  void add_splatting_paths(std::uint64_t paths);
  [[nodiscard]] bool splats() const { return !splats_.empty(); }

  /// Part `number` of `parts` of the film, to whose pixels one thread adds while others add to the other
  /// parts. Rows of tiles are dealt out in turn, see of_row(). After join(),
  /// count_blocks() and add_splatting_paths() the film is the same, bit for bit, as if it had added
  /// everything itself.
  class Part {
  public:
    Part(Film& film, std::size_t number, std::size_t parts) : film_(film), number_(number), parts_(parts) {
      tally_.pixels_per_path = film.evidence_.tally().pixels_per_path;
      paths_ = film.splatting_paths_;
    }
    [[nodiscard]] std::size_t row_of_tiles() const { return film_.row_of_tiles(); }
    /// The part of a row of tiles.
    [[nodiscard]] static std::size_t of_row(std::size_t row, std::size_t parts) { return row % parts; }
    [[nodiscard]] bool has_row_of_tiles(std::size_t row) const { return of_row(row, parts_) == number_; }
    void add(std::size_t pixel, const BlockSum& block, std::uint32_t samples) {
      film_.add(pixel, block, samples, tally_);
    }
    void add_splat(std::size_t pixel, const std::array<double, 3>& value, bool sized) {
      film_.add_splat(pixel, value, sized, tally_);
    }
    [[gnu::always_inline]] void expect_splat(std::size_t pixel) const { film_.expect_splat(pixel); }
    void add_splatting_paths(std::uint64_t paths) {
      paths_ += paths;
      tally_.pixels_per_path = film_.evidence_.pixels_per_path(paths_);
    }

  private:
    friend Film;
    Film& film_;
    std::size_t number_, parts_;
    Evidence::Tally tally_;
    std::uint64_t paths_; // splatting ones of the film so far
  };
  /// As Part's: what adds to a film or to a part may be one template.
  [[nodiscard]] bool has_row_of_tiles(std::size_t) const { return true; }
  void join(const Part& part) { evidence_.add(part.tally_); }
  /// Counts blocks that parts have added.
  void count_blocks(std::uint64_t blocks, std::uint32_t samples);
  /// Whether parts may add the next `samples` samples: not if something depends on the order of all pixels.
  [[nodiscard]] bool can_be_divided(std::uint64_t samples) const {
    return storage_ == Storage::memory && !clamp_ && !techniques_ &&
           !evidence_.notes_growth(this->samples() + samples);
  }

  /// Samples of a block are not independent of each other, but blocks are: variances are estimated from the
  /// sums of blocks. To be called before the first add().
  void use_dependent_samples() {
    if (!dependent_samples()) blocks_of_pixels_.resize(pixels_.size(), storage_);
  }
  [[nodiscard]] bool dependent_samples() const { return !blocks_of_pixels_.empty(); }

  /// Contributions may be negative, by a control variate. The mean of a pixel of radiance 0 then has either
  /// sign, so that errors are relative to at least least_scale().
  void use_signed_contributions() { signed_ = true; }
  /// The mean radiance of the image, in units; 0 if no contribution is negative.
  [[nodiscard]] double least_scale() const;

  /// Also records the contributions of each technique from here on.
  void use_techniques() {
    if (!techniques_) techniques_.emplace(pixels_.size());
  }
  [[nodiscard]] Techniques* techniques() { return techniques_ ? &*techniques_ : nullptr; }
  /// One technique's image from its sums in `techniques()`: radiance per pixel.
  [[nodiscard]] std::vector<std::array<double, 3>>
  technique_image(const std::vector<std::array<double, 3>>& sums) const;

  /// Mean radiance of a pixel; 0 without samples.
  [[nodiscard]] std::array<double, 3> mean(std::size_t pixel) const;
  [[nodiscard]] double mean(std::size_t pixel, std::size_t channel) const {
    return unit_ * mean_in_units(pixel, channel);
  }
  /// Unbiased variance of that mean, per channel; 0 with fewer than two samples. Never negative.
  [[nodiscard]] std::array<double, 3> variance_of_mean(std::size_t pixel) const;
  [[nodiscard]] double variance_of_mean(std::size_t pixel, std::size_t channel) const {
    return unit_ * unit_ * variance_in_units(pixel, channel);
  }
  /// Whether every pixel has at least two samples, its own or splatting paths.
  [[nodiscard]] bool has_variance() const;

  /// Means over the pixels and channels that are not black. See also use_signed_contributions().
  struct RelativeError {
    /// Variance of one sample / mean^2. 0 if no pixel has two samples and a mean above 0.
    double variance = 0.0;
    /// Standard error of the mean / mean. Infinite until every pixel has two samples; 0 for a black image.
    double standard_error = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] RelativeError relative_error(const Progress& progress = {}) const;
  [[nodiscard]] double relative_variance() const { return relative_error().variance; }
  /// RelativeError::standard_error; fast while it is infinite.
  [[nodiscard]] double relative_standard_error() const {
    return has_variance() ? relative_error().standard_error : RelativeError().standard_error;
  }
  [[nodiscard]] double samples_per_pixel() const; ///< mean over the pixels

  /// Samples of all pixels, or splatting paths if pixels have no samples of their own.
  [[nodiscard]] std::uint64_t samples() const { return own_samples_ > 0 ? own_samples_ : splatting_paths_; }
  /// The number of independent sums that the variance is estimated from: blocks of samples and splatting
  /// paths.
  [[nodiscard]] std::uint64_t contributors() const { return blocks_ + splatting_paths_; }
  [[nodiscard]] const Evidence& evidence() const { return evidence_; }

  /// Moments of the contributions to a pixel, summed over its channels, in units.
  struct Spread {
    double mean = 0.0;    ///< radiance, mean over channels
    double squares = 0.0; ///< sum of squared deviations from the mean: about samples x variance of one
    double variance_of_squares = 0.0; ///< from 0 to squares^2, which means that one sample brings them
  };
  [[nodiscard]] Spread spread(std::size_t pixel) const;

  /// The film's whole state but its size: a film of that size that is read from an archive continues as the
  /// written one, bit for bit. Arrays have no lengths that a file could forge: memory is bounded by the
  /// archive's size.
  template<class Archive>
  void serialize(Archive& archive) {
    archive(unit_);
    for (Pixel& pixel : pixels()) archive(pixel);
    bool with_splats = splats(), with_techniques = techniques_.has_value(), dependent = dependent_samples();
    archive(with_splats);
    if (with_splats && !splats()) use_splats();
    for (Splats& splats : splats_) archive(splats);
    archive(dependent);
    if (dependent && !dependent_samples()) use_dependent_samples();
    for (BlockMoments& blocks : Elements(blocks_of_pixels_)) archive(blocks);
    archive(splatting_paths_, own_samples_, blocks_, squared_block_samples_, evidence_, clamp_, clamped_,
            clamped_of_splats_, with_techniques);
    if (!with_techniques) return;
    use_techniques();
    archive(*techniques_);
  }
  /// The sums that contradict each other or what was rendered: `samples_of(pixel)` of its own and `paths`
  /// that splat. Empty if there are none.
  [[nodiscard]] std::string contradiction(const std::function<std::uint64_t(std::size_t pixel)>& samples_of,
                                          std::uint64_t paths) const;

private:
  void clamp(std::array<double, 3>& value);
  void add(std::size_t pixel, const BlockSum& block, std::uint32_t samples, Evidence::Tally& tally);
  void add_splat(std::size_t pixel, const std::array<double, 3>& value, bool sized, Evidence::Tally& tally) {
    Splats& sums = splats_[pixel];
    double square = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      sums.sum[channel] += value[channel];
      const double channel_square = value[channel] * value[channel];
      sums.sum_of_squares[channel] += channel_square;
      square += channel_square;
    }
    sums.sum_of_fourths += square * square;
    if (sized) count_splat(pixel, square, value[0] + value[1] + value[2], tally);
  }
  void count_splat(std::size_t pixel, double square, double sum, Evidence::Tally& tally);
  [[nodiscard]] double splatting_paths_per_pixel() const;
  [[nodiscard]] double equal_blocks_per_pixel() const;
  // The sum over a pixel's independent values (samples or blocks) of (value - number of samples x mean of the
  // pixel)^2.
  [[nodiscard]] double squared_deviations(std::size_t pixel, std::size_t channel) const;
  [[nodiscard]] double variance_of_own(std::size_t pixel, std::size_t channel) const;
  [[nodiscard]] bool has_variance(std::size_t pixel) const;
  void report(const Progress& progress, std::size_t pixel) const; // now and then
  [[nodiscard]] double variance_of_squares(const Pixel& own, double squares, double mean) const;
  [[nodiscard]] double mean_in_units(std::size_t pixel, std::size_t channel) const;
  [[nodiscard]] double variance_in_units(std::size_t pixel, std::size_t channel) const;

  int width_, height_;
  double unit_ = 1.0;
  Storage storage_; ///< of `pixels_` and `blocks_of_pixels_`
  PagedArray<Pixel> pixels_;
  std::vector<Splats, ZeroedMemory<Splats>> splats_; ///< empty where nothing splats
  PagedArray<BlockMoments> blocks_of_pixels_;        ///< empty where samples are independent
  std::uint64_t splatting_paths_ = 0, own_samples_ = 0, blocks_ = 0;
  double squared_block_samples_ = 0.0; ///< sum over blocks of samples^2
  Evidence evidence_;
  std::optional<double> clamp_; ///< in units
  double clamped_ = 0.0;        ///< of blocks, in units, sum over channels
  double clamped_of_splats_ = 0.0;
  std::optional<Techniques> techniques_;
  bool signed_ = false; ///< contributions may be negative
};

} // namespace phlux::film
