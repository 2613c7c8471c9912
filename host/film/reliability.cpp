#include "film/reliability.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace phlux::film {
namespace {

constexpr double channels = 3.0;
constexpr double top_part = 1e-3;
constexpr double least_tail = 30.0;            // contributions for an index of the tail
constexpr double largest_variance_error = 0.2; // for a relative error of 10% of the standard error
constexpr double infinite_variance = 2.0;      // index of the tail

// Sums over the pixels of a tile or of the image, relative to the radiance of each.
struct Spread {
  double pixels = 0.0, mean = 0.0, squares = 0.0, fourths = 0.0, variance = 0.0;
  // Relative variance of `squares`. The number of blocks is not random, so that equal blocks have no
  // variance.
  [[nodiscard]] double relative_variance(double blocks) const {
    if (!(squares > 0.0)) return 0.0;
    const double of_equal_blocks = blocks > 0.0 ? 1.0 / blocks : 0.0;
    return std::max(0.0, fourths / (squares * squares) - of_equal_blocks);
  }
};

std::vector<Spread> spreads_of(const Film& film) {
  std::vector<Spread> tiles(film.evidence().tiles().count());
  const std::size_t pixels = film.pixels().size();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    Spread& tile = tiles[film.evidence().tiles().tile_of(pixel)];
    tile.mean += film.spread(pixel).mean;
    tile.pixels += 1.0;
  }
  const double samples_per_pixel = film.samples_per_pixel();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    Spread& tile = tiles[film.evidence().tiles().tile_of(pixel)];
    const Film::Spread own = film.spread(pixel);
    const double scale = std::max(own.mean, tile.mean / tile.pixels);
    if (!(scale > 0.0)) continue;
    tile.squares += own.squares / (scale * scale);
    tile.fourths += own.fourths / (scale * scale * scale * scale);
    tile.variance += own.squares / (channels * scale * scale * samples_per_pixel);
  }
  return tiles;
}

// Blocks of samples per pixel; 0 with splats, whose number is random.
double blocks_per_pixel(const Film& film) {
  if (film.splats()) return 0.0;
  return static_cast<double>(film.contributors()) / static_cast<double>(film.pixels().size());
}

// Relative variance of a pixel's variance estimate, from all pixels of its tile.
double pixel_relative_variance(const Spread& tile, double blocks) {
  return tile.pixels * tile.relative_variance(blocks * tile.pixels);
}

// From the largest contributions, as many as the square root of their number: that number goes to infinity,
// and its share to 0, as Hill's estimate requires. Sizes are squares of contributions, whose index is twice
// theirs.
std::optional<double> tail_index(const Film& film) {
  const double count = std::max(least_tail, std::sqrt(static_cast<double>(film.contributors())));
  const std::optional<double> of_squares = film.evidence().sizes().tail_index(count);
  return of_squares ? std::optional(2.0 * *of_squares) : std::nullopt;
}

// Slope of the logarithm of the largest contribution over the last two doublings of the samples.
std::optional<double> growth_of(const std::vector<Growth>& history) {
  constexpr std::size_t doublings = 2;
  if (history.size() <= doublings) return std::nullopt;
  const Growth &now = history.back(), &then = history[history.size() - 1 - doublings];
  if (!(then.largest > 0.0)) return std::nullopt;
  return std::log(now.largest / then.largest) /
         std::log(static_cast<double>(now.samples) / static_cast<double>(then.samples));
}

void sum_tiles(Reliability& r, const Film& film) {
  const std::vector<Spread> tiles = spreads_of(film);
  const double blocks = blocks_per_pixel(film);
  Spread all;
  double lit_pixels = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const Spread& tile = tiles[i];
    all.pixels += tile.pixels;
    all.squares += tile.squares;
    all.fourths += tile.fourths;
    all.variance += tile.variance;
    if (tile.mean > 0.0) {
      lit_pixels += tile.pixels;
      r.understated += tile.pixels * std::min(1.0, pixel_relative_variance(tile, blocks) / 8.0);
    }
    if (tile.variance <= worst) continue;
    worst = tile.variance;
    const auto [x, y] = film.evidence().tiles().centre_of(i);
    r.worst_x = std::min(x, film.width() - 1);
    r.worst_y = std::min(y, film.height() - 1);
  }
  r.variance = all.variance / all.pixels;
  r.variance_error = std::sqrt(all.relative_variance(blocks * all.pixels));
  if (lit_pixels > 0.0) r.understated /= lit_pixels;
  if (all.variance > 0.0) r.worst_share = worst / all.variance;
}

std::vector<std::string> reasons_for_doubt(const Reliability& r, double samples_per_pixel) {
  std::vector<std::string> result;
  if (samples_per_pixel < least_samples)
    return {fmt::format("{:.3g} samples per pixel are too few to tell", samples_per_pixel)};
  if (!(r.variance > 0.0)) return {"all samples are equal: rare contributions may be missing"};
  if (r.understated > most_understated)
    result.push_back(fmt::format("it may be {:.0f}% too small", 100.0 * r.understated));
  if (r.variance_error > largest_variance_error)
    result.push_back(fmt::format("about {:.2g} samples dominate the variance",
                                 1.0 / (r.variance_error * r.variance_error)));
  // With infinite variance, the share of a few largest contributions does not decrease with more samples.
  if (r.tail_index && *r.tail_index <= infinite_variance && r.variance_error > 0.5 * largest_variance_error)
    result.push_back(fmt::format(
        "the variance may be infinite: the tail of contributions x falls as x^-{:.2g}", *r.tail_index));
  return result;
}

} // namespace

Reliability reliability_of(const Film& film) {
  Reliability r;
  sum_tiles(r, film);
  r.top_share =
      film.evidence().sizes().share_of_largest(std::ceil(top_part * static_cast<double>(film.samples())));
  r.tail_index = tail_index(film);
  r.growth = growth_of(film.evidence().history());
  r.reasons = reasons_for_doubt(r, film.samples_per_pixel());
  r.trusted = r.reasons.empty();
  return r;
}

std::vector<float> reliability_map(const Film& film) {
  const std::vector<Spread> tiles = spreads_of(film);
  const double blocks = blocks_per_pixel(film);
  std::vector<float> map(film.pixels().size());
  for (std::size_t pixel = 0; pixel < map.size(); ++pixel) {
    const Spread& tile = tiles[film.evidence().tiles().tile_of(pixel)];
    if (tile.mean > 0.0)
      map[pixel] = static_cast<float>(std::max(0.0, 1.0 - std::sqrt(pixel_relative_variance(tile, blocks))));
  }
  return map;
}

} // namespace phlux::film
