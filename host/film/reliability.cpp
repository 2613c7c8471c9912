#include "film/reliability.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace phlux::film {
namespace {

constexpr double channels = 3.0;
constexpr double top_part = 1e-3;
constexpr double least_tail = 30.0;       // contributions for an index of the tail
constexpr double infinite_variance = 2.0; // index of the tail
// Relative variance of a sample below which it is rounding, see Film: 2^-24 times the length of a block.
constexpr double rounding = 1e-6;

constexpr double interval = 1.96; // in standard errors, of nominal_coverage
// What that coverage loses, to first order, per relative variance r = 1/k of a pixel's variance that k rare
// samples of equal light bring, with z = 1.96 and the normal density phi (Hall 1992, The Bootstrap and
// Edgeworth Expansion, 2.6): 2 z phi(z) ((z^4 + 2 z^2 - 3) / 18 - (z^2 - 3) / 12).
constexpr double lost_per_variance = 0.23;

// The noise of a pixel, as radiance, mean over channels.
struct Noise {
  double radiance = 0.0, error = 0.0; // mean and its standard error
  // Relative variance of error^2, at most 1: 1/k if k samples of equal light bring it.
  double concentration = 0.0;
  // Light of rare samples: that of the one that brings the error, k^(-1/4) times that of each of k.
  [[nodiscard]] double rare() const {
    const double root = std::sqrt(concentration);
    return error * root * std::sqrt(root);
  }
};

// Sums over the pixels of a tile.
struct Tile {
  double pixels = 0.0, radiance = 0.0;
  double rare = 0.0;                       // Noise::rare() relative to scale()
  double noisy = 0.0, concentration = 0.0; // number of noisy pixels, sum over them
  // Relative to the radiance of the pixel or of the tile, whichever is larger.
  double squares = 0.0, variance_of_squares = 0.0;

  // The radiance to which the rare light of a pixel is in proportion: without that light, which differs.
  [[nodiscard]] double scale(const Noise& noise) const {
    return std::max(noise.radiance - noise.rare(), radiance / pixels);
  }
};

// What is predicted for a pixel.
struct Prediction {
  double weight = 1.0; // probability that the right value is not 0
  double coverage = 0.0;
  double error = 0.0; // standard error / radiance
};

// Sums of predictions over the pixels, each with its weight.
struct Predictions {
  double weight = 0.0, coverage = 0.0, error = 0.0;

  void add(const Prediction& p, double pixels = 1.0) {
    weight += pixels * p.weight;
    coverage += pixels * p.weight * p.coverage;
    error += pixels * p.weight * p.error;
  }
};

} // namespace

class Tiles {
public:
  explicit Tiles(const Film& film, const Progress& progress = {})
      : film_(film), samples_(film.samples_per_pixel()), least_scale_(film.least_scale()),
        tiles_(film.evidence().tiles().count()) {
    const std::size_t pixels = film.pixels().size(), row_of_tiles = std::size_t{TileMeans::tile_edge} *
                                                                    static_cast<std::size_t>(film.width());
    double black_in_quiet_tiles = 0.0;
    std::vector<Film::Spread> spreads;
    for (std::size_t first = 0; first < pixels; first += row_of_tiles) {
      if (progress) progress(static_cast<double>(first) / static_cast<double>(pixels));
      spreads.clear();
      for (std::size_t pixel = first; pixel < std::min(first + row_of_tiles, pixels); ++pixel) {
        spreads.push_back(spread(pixel));
        Tile& tile = tiles_[index(pixel)];
        tile.radiance += spreads.back().mean;
        tile.pixels += 1.0;
      }
      for (std::size_t i = 0; i < spreads.size(); ++i) add(tiles_[index(first + i)], spreads[i]);
      for (std::size_t i = 0; i < spreads.size(); ++i) {
        const Tile& tile = tiles_[index(first + i)];
        if (!(spreads[i].mean > 0.0) && !(tile.noisy > 0.0))
          black_in_quiet_tiles += 1.0; // their prediction depends on the whole image
        else
          predictions_.add(predict(tile, spreads[i]));
      }
    }
    predictions_.add(predict(Tile(), Film::Spread()), black_in_quiet_tiles);
  }

  [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
  [[nodiscard]] const Tile& all() const { return all_; }
  [[nodiscard]] const Predictions& predictions() const { return predictions_; }
  [[nodiscard]] Prediction predict(std::size_t pixel) const {
    return predict(tiles_[index(pixel)], spread(pixel));
  }

private:
  // With a radiance to which errors are relative.
  [[nodiscard]] Film::Spread spread(std::size_t pixel) const {
    Film::Spread spread = film_.spread(pixel);
    if (spread.mean != 0.0) spread.mean = std::max(spread.mean, least_scale_);
    return spread;
  }

  [[nodiscard]] std::size_t index(std::size_t pixel) const { return film_.evidence().tiles().tile_of(pixel); }

  void add(Tile& tile, const Film::Spread& spread) {
    const double scale = std::max(spread.mean, tile.radiance / tile.pixels), square = scale * scale;
    if (!(scale > 0.0)) return;
    const Noise noise = noise_of(spread);
    tile.rare += noise.rare() / tile.scale(noise);
    for (Tile* sums : {&tile, &all_}) {
      sums->noisy += noise.error > 0.0 ? 1.0 : 0.0;
      sums->concentration += noise.concentration;
      sums->squares += spread.squares / square;
      sums->variance_of_squares += spread.variance_of_squares / (square * square);
    }
  }

  // A pixel has met its own share of the rare light of its tile, and lacks the difference to the mean.
  [[nodiscard]] Prediction predict(const Tile& tile, const Film::Spread& spread) const {
    const Noise noise = noise_of(spread);
    if (!(noise.radiance > 0.0))
      return {.weight = probability_of_no_sample(tile), .coverage = 0.0, .error = 1.0};
    if (!(noise.error > 0.0)) return {.weight = 1.0, .coverage = nominal_coverage, .error = 0.0};
    const double own = noise.rare(), rare = tile.rare / tile.pixels * tile.scale(noise);
    const double missing = std::max(0.0, rare - own);
    return {.weight = 1.0,
            .coverage =
                std::max(0.0, coverage_with(missing / noise.error) - lost_per_variance * noise.concentration),
            .error = std::hypot(noise.error, missing) / (std::max(0.0, noise.radiance - own) + rare)};
  }

  [[nodiscard]] Noise noise_of(const Film::Spread& spread) const {
    Noise noise{.radiance = spread.mean};
    if (spread.squares <= rounding * channels * samples_ * spread.mean * spread.mean) return noise;
    noise.error = std::sqrt(spread.squares / channels) / samples_;
    noise.concentration = std::min(1.0, spread.variance_of_squares / (spread.squares * spread.squares));
    return noise;
  }

  // Probability that an interval holds the right value of a mean with this bias, in standard errors.
  static double coverage_with(double bias) {
    const auto above = [](double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); };
    return 1.0 - above(interval - bias) - above(interval + bias);
  }

  // Probability that a pixel is black only because it has met no sample with light: e^-k if k such samples
  // are expected. k is estimated from pixels that have met one, which count one too many: hence e^(1 - k).
  [[nodiscard]] double probability_of_no_sample(const Tile& tile) const {
    const Tile& noisy = tile.noisy > 0.0 ? tile : all_;
    return noisy.concentration > 0.0 ? std::exp(1.0 - noisy.noisy / noisy.concentration) : 0.0;
  }

  const Film& film_;
  double samples_, least_scale_;
  std::vector<Tile> tiles_;
  Tile all_;
  Predictions predictions_;
};

namespace {

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

void add_variance(Reliability& r, const Tiles& tiles, const Film& film) {
  const Tile& all = tiles.all();
  if (!(all.squares > 0.0)) return;
  r.variance =
      all.squares / (channels * static_cast<double>(film.pixels().size()) * film.samples_per_pixel());
  r.variance_error = std::sqrt(all.variance_of_squares) / all.squares;
  const auto worst = std::ranges::max_element(tiles.tiles(), {}, &Tile::squares);
  const auto [x, y] =
      film.evidence().tiles().centre_of(static_cast<std::size_t>(worst - tiles.tiles().begin()));
  r.worst_x = std::min(x, film.width() - 1);
  r.worst_y = std::min(y, film.height() - 1);
  r.worst_share = worst->squares / all.squares;
}

std::vector<std::string> reasons_for_doubt(const Reliability& r, double samples_per_pixel) {
  if (samples_per_pixel < least_samples)
    return {fmt::format("{:.3g} samples per pixel are too few to tell", samples_per_pixel)};
  if (!(r.variance > 0.0)) return {"all samples are equal: rare contributions may be missing"};
  std::vector<std::string> result;
  if (r.coverage < least_coverage)
    result.push_back(
        fmt::format("95% intervals contain the true value in {:.0f}% of the pixels", 100.0 * r.coverage));
  if (r.variance_error > largest_variance_error)
    result.push_back(fmt::format("about {:.2g} samples dominate the variance",
                                 1.0 / (r.variance_error * r.variance_error)));
  // With infinite variance, the share of a few largest contributions does not decrease with more samples.
  if (!result.empty() && r.tail_index && *r.tail_index <= infinite_variance &&
      r.variance_error > largest_variance_error / 3.0)
    result.push_back("the variance may be infinite");
  return result;
}

} // namespace

Reliability reliability_of(const Film& film, const Progress& progress) {
  Reliability r;
  const Tiles tiles(film, progress);
  add_variance(r, tiles, film);
  if (const Predictions& all = tiles.predictions(); all.weight > 0.0) {
    r.coverage = all.coverage / all.weight;
    r.relative_standard_error = all.error / all.weight;
  }
  r.top_share =
      film.evidence().sizes().share_of_largest(std::ceil(top_part * static_cast<double>(film.samples())));
  r.tail_index = tail_index(film);
  r.growth = growth_of(film.evidence().history());
  r.reasons = reasons_for_doubt(r, film.samples_per_pixel());
  r.trusted = r.reasons.empty();
  return r;
}

ReliabilityMap::ReliabilityMap(const Film& film, const Progress& progress)
    : tiles_(std::make_unique<const Tiles>(film, progress)) {}

ReliabilityMap::~ReliabilityMap() = default;

float ReliabilityMap::operator[](std::size_t pixel) const {
  return static_cast<float>(tiles_->predict(pixel).coverage);
}

std::vector<float> reliability_map(const Film& film) {
  const ReliabilityMap reliability(film);
  std::vector<float> map(film.pixels().size());
  for (std::size_t pixel = 0; pixel < map.size(); ++pixel) map[pixel] = reliability[pixel];
  return map;
}

} // namespace phlux::film
