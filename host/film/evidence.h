// Statistics of contributions from which a film judges whether its error estimate is reliable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/contribution_sizes.h"

namespace phlux::film {

/// The largest contribution to the variance so far, relative as in ContributionSizes.
struct Growth {
  std::uint64_t samples = 0;
  double largest = 0.0;

  template<class Archive>
  void serialize(Archive& archive) {
    archive(samples, largest);
  }
};

/// Sizes are relative to the larger of the tile's mean and the pixel's mean before the contribution, so that
/// a firefly is not compared with itself. Sums are over channels.
class Evidence {
public:
  Evidence(int width, int height);

  /// The sizes of contributions to any tile, and the number of pixels per splatting path. A thread that adds
  /// to a part of the tiles has its own tally; add() adds its sizes to those of the film.
  struct Tally {
    ContributionSizes sizes;
    double pixels_per_path = 0.0; ///< for the splatting paths so far
  };
  [[nodiscard]] Tally& tally() { return tally_; }
  [[nodiscard]] double pixels_per_path(std::uint64_t paths) const {
    return pixels_ / static_cast<double>(paths);
  }
  void add(const Tally& tally) { tally_.sizes.add(tally.sizes); }

  /// A block of samples with sum `sum` for a pixel whose mean was `mean_before`.
  void add_block(std::size_t pixel, double square, double sum, std::uint32_t samples, double mean_before,
                 Tally& tally);
  /// A splat that represents `count` splats, for a pixel whose sum of splats was `sum_before`.
  void add_splat(std::size_t pixel, double square, double sum, std::uint32_t count, double sum_before,
                 Tally& tally);
  /// Their number in the whole image so far.
  void set_splatting_paths(std::uint64_t paths) { tally_.pixels_per_path = pixels_per_path(paths); }
  /// Records the largest contribution at each doubling of the image's samples.
  void note_growth(std::uint64_t samples);
  [[nodiscard]] bool notes_growth(std::uint64_t samples) const { return samples >= next_growth_; }

  [[nodiscard]] const ContributionSizes& sizes() const { return tally_.sizes; }
  [[nodiscard]] const TileMeans& tiles() const { return tiles_; }
  [[nodiscard]] const std::vector<Growth>& history() const { return history_; }

  template<class Archive>
  void serialize(Archive& archive) {
    auto doublings = static_cast<std::uint8_t>(history_.size());
    archive(tally_.sizes, tiles_, doublings, tally_.pixels_per_path, next_growth_);
    history_.resize(doublings);
    for (Growth& growth : history_) archive(growth);
  }

  /// Whether all numbers are in their ranges.
  [[nodiscard]] bool is_sound() const;

private:
  Tally tally_;
  TileMeans tiles_;
  std::vector<Growth> history_;
  double pixels_;
  std::uint64_t next_growth_; // samples at the next entry of the history
};

} // namespace phlux::film
