#include "film/evidence.h"

#include <algorithm>
#include <cmath>

namespace phlux::film {

Evidence::Evidence(int width, int height)
    : tiles_(width, height), pixels_(static_cast<double>(width) * height),
      next_growth_(16 * static_cast<std::uint64_t>(pixels_)) {} // before, many pixels have no samples

void Evidence::add_block(std::size_t pixel, double square, double sum, std::uint32_t samples,
                         double mean_before, Tally& tally) {
  const std::size_t tile = tiles_.tile_of(pixel);
  tiles_.add_samples(tile, sum, samples);
  const double mean = std::max(mean_before, tiles_.mean_of_samples(tile)) +
                      tiles_.mean_of_splats(tile) * tally.pixels_per_path;
  if (mean > 0.0) tally.sizes.add(square / (mean * mean));
}

void Evidence::add_splat(std::size_t pixel, double square, double sum, std::uint32_t count, double sum_before,
                         Tally& tally) {
  const std::size_t tile = tiles_.tile_of(pixel);
  tiles_.add_splat(tile, count * sum);
  const double mean = std::max(sum_before, tiles_.mean_of_splats(tile)) * tally.pixels_per_path +
                      tiles_.mean_of_samples(tile);
  if (mean > 0.0) tally.sizes.add(square / (mean * mean), count);
}

bool Evidence::is_sound() const {
  return !tiles_.has_nan() && std::isfinite(tally_.pixels_per_path) && next_growth_ > 0 &&
         std::ranges::all_of(history_, [](const Growth& growth) {
           return growth.samples > 0 && std::isfinite(growth.largest) && growth.largest >= 0.0;
         });
}

void Evidence::note_growth(std::uint64_t samples) {
  if (!notes_growth(samples)) return;
  next_growth_ = 2 * samples;
  history_.push_back({samples, tally_.sizes.largest()});
}

} // namespace phlux::film
