#include "film/contribution_sizes.h"

#include <algorithm>
#include <cmath>

namespace phlux::film {

double ContributionSizes::lower_edge(std::size_t bin) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bin << dropped_bits));
}

double ContributionSizes::size_of(std::size_t bin) {
  constexpr double half_a_bin = 1.125;
  return bin == 0 ? 0.0 : half_a_bin * lower_edge(bin);
}

double ContributionSizes::largest() const {
  for (std::size_t bin = bins; bin-- > 1;)
    if (counts_[bin] > 0) return size_of(bin);
  return 0.0;
}

double ContributionSizes::share_of_largest(double count) const {
  double all = 0.0, of_largest = 0.0;
  for (std::size_t bin = bins; bin-- > 1;) {
    const auto here = static_cast<double>(counts_[bin]);
    all += here * size_of(bin);
    of_largest += std::clamp(count, 0.0, here) * size_of(bin);
    count -= here;
  }
  return all > 0.0 ? of_largest / all : 0.0;
}

std::optional<double> ContributionSizes::tail_index(double count) const {
  double found = 0.0, logarithms = 0.0;
  for (std::size_t bin = bins; bin-- > 1;) {
    const auto here = static_cast<double>(counts_[bin]);
    found += here;
    logarithms += here > 0.0 ? here * std::log(size_of(bin)) : 0.0;
    if (found < count || found <= 0.0) continue;
    if (here == found) return std::nullopt;
    return found / (logarithms - found * std::log(lower_edge(bin)));
  }
  return std::nullopt;
}

TileMeans::TileMeans(int width, int height)
    : width_(static_cast<std::uint32_t>(width)), tiles_across_((width_ + tile_edge - 1) / tile_edge),
      rows_per_pixel_(1.0 / width) {
  const auto part = [](int size, std::size_t i) {
    return std::min(tile_edge, size - static_cast<int>(i) * tile_edge);
  };
  const auto tiles_down = static_cast<std::size_t>((height + tile_edge - 1) / tile_edge);
  tiles_.resize(tiles_across_ * tiles_down);
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile)
    tiles_[tile].one_by_pixels =
        1.0 / (part(width, tile % tiles_across_) * part(height, tile / tiles_across_));
}

bool TileMeans::has_nan() const {
  return std::ranges::any_of(tiles_, [](const Tile& tile) {
    return std::isnan(tile.sum) || std::isnan(tile.mean) || std::isnan(tile.splats);
  });
}

std::array<int, 2> TileMeans::centre_of(std::size_t tile) const {
  const auto place = [](std::size_t i) { return static_cast<int>(i) * tile_edge + tile_edge / 2; };
  return {place(tile % tiles_across_), place(tile / tiles_across_)};
}

} // namespace phlux::film
