// A histogram of contributions to the variance, which shows whether a few of them dominate it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace phlux::film {

/// Numbers of contributions to the variance by size, in bins of a quarter octave. Sizes are relative to the
/// squared mean radiance of the pixel.
class ContributionSizes {
public:
  /// Adds `count` contributions of a size >= 0; NaN, of sums that have overflowed, counts as 0.
  void add(double size, std::uint32_t count = 1) {
    const auto bounded =
        size > 0.0 ? static_cast<float>(std::min(size, double{std::numeric_limits<float>::max()})) : 0.0F;
    counts_[std::bit_cast<std::uint32_t>(bounded) >> dropped_bits] += count;
  }
  void add(const ContributionSizes& others) {
    for (std::size_t bin = 0; bin < bins; ++bin) counts_[bin] += others.counts_[bin];
  }
  [[nodiscard]] double largest() const; ///< 0 if empty
  /// Share of the `count` largest in the sum of all; 0 if empty.
  [[nodiscard]] double share_of_largest(double count) const;
  /// Index a of the tail, P(size > x) ~ x^-a: Hill's estimate (1975) from at least the `count` largest.
  /// Nothing if there are fewer, or all are in one bin.
  [[nodiscard]] std::optional<double> tail_index(double count) const;

  template<class Archive>
  void serialize(Archive& archive) {
    archive(counts_);
  }

private:
  // The exponent of a float and two bits of its mantissa.
  static constexpr unsigned dropped_bits = 21;
  static constexpr std::size_t bins = 255 << 2; // of finite floats
  static double lower_edge(std::size_t bin);
  static double size_of(std::size_t bin); ///< the bin's middle; 0 for bin 0
  std::array<std::uint64_t, bins> counts_{};
};

/// Running means over tiles of tile_edge x tile_edge pixels, with which contributions are compared if their
/// pixels have few samples.
class TileMeans {
public:
  static constexpr int tile_edge = 16;

  TileMeans(int width, int height);
  [[nodiscard]] std::size_t count() const { return tiles_.size(); }
  [[nodiscard]] std::size_t tile_of(std::size_t pixel) const {
    // Faster than an integer division and as exact: the 0.5 keeps the quotient away from whole numbers.
    const auto row = static_cast<std::uint32_t>((static_cast<double>(pixel) + 0.5) * rows_per_pixel_);
    const std::uint32_t column = static_cast<std::uint32_t>(pixel) - row * width_;
    return std::size_t{row / tile_edge} * tiles_across_ + column / tile_edge;
  }
  /// In pixels, x and y from the top left.
  [[nodiscard]] std::array<int, 2> centre_of(std::size_t tile) const;

  void add_samples(std::size_t tile, double sum, std::uint32_t samples) {
    tiles_[tile].samples += samples;
    tiles_[tile].sum += sum;
    tiles_[tile].mean = tiles_[tile].sum / static_cast<double>(tiles_[tile].samples);
  }
  void add_splat(std::size_t tile, double sum) { tiles_[tile].splats += sum; }
  /// Mean of the samples of the tile's pixels.
  [[nodiscard]] double mean_of_samples(std::size_t tile) const { return tiles_[tile].mean; }
  /// Mean of the splats, for one splatting path per pixel.
  [[nodiscard]] double mean_of_splats(std::size_t tile) const {
    return tiles_[tile].splats * tiles_[tile].one_by_pixels;
  }

  template<class Archive>
  void serialize(Archive& archive) {
    for (Tile& tile : tiles_) archive(tile);
  }

  [[nodiscard]] bool has_nan() const;

private:
  struct Tile {
    double sum = 0.0, mean = 0.0, splats = 0.0, one_by_pixels = 0.0;
    std::uint64_t samples = 0;

    template<class Archive>
    void serialize(Archive& archive) {
      archive(sum, mean, splats, samples);
    }
  };
  std::uint32_t width_, tiles_across_;
  double rows_per_pixel_;
  std::vector<Tile> tiles_;
};

} // namespace phlux::film
