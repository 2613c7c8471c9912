// The error estimates of `phlux bench precision` for pairs of images with known differences.
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "bench/precision/precision_error.h"

using namespace phlux::bench;

namespace {

constexpr std::size_t pixels = 1600, repeats = 8;
constexpr double samples = 16;

// Radiance 2 with this noise in images of 16 samples per pixel. float32 adds `bias`, and random differences
// as from samples on other paths. The last tenth of the pixels has no noise.
PrecisionPairs known_pairs(double noise, double bias, double differences) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  PrecisionPairs pairs;
  for (std::size_t i = 0; i < repeats; ++i) {
    ImageEstimate float32{{}, std::vector<double>(pixels, samples)}, float64 = float32;
    for (std::size_t value = 0; value < 3 * pixels; ++value) {
      const bool quiet = value >= 3 * pixels * 9 / 10;
      float64.radiance.push_back(2 + (quiet ? 0 : noise * normal(random)));
      float32.radiance.push_back(float64.radiance.back() + bias + (quiet ? 0 : differences * normal(random)));
    }
    pairs.float32.push_back(float32);
    pairs.float64.push_back(float64);
  }
  for (std::size_t value = 0; value < 3 * pixels; ++value)
    pairs.variance.push_back(value >= 3 * pixels * 9 / 10 ? 0 : noise * noise / repeats);
  return pairs;
}

} // namespace

TEST_CASE("the error of float32 is separated into a systematic part and samples on other paths") {
  // Noise of one sample 0.4, of 4096 samples 0.4 / 64, in nine tenths of the pixels.
  const double unit = 0.1 * std::sqrt(samples * 0.9 / unit_samples);
  const PrecisionError biased = precision_error(known_pairs(0.1, 0.001, 0.002));
  CHECK(biased.variance == Approx(0.01 * samples * 0.9 / 4).epsilon(0.05));
  CHECK(biased.systematic == Approx(0.001 / unit).epsilon(0.1));
  CHECK(biased.systematic_most > biased.systematic);
  CHECK(biased.systematic_most < 1.3 * biased.systematic);
  const double other_way = 0.002 * std::sqrt(0.9 * samples / unit_samples) / unit;
  CHECK(biased.difference == Approx(std::hypot(0.001 / unit, other_way)).epsilon(0.1));
  CHECK(biased.mean.value == Approx(0.0005).epsilon(0.1));
  CHECK(biased.mean.value > 10 * biased.mean.standard_error);
  CHECK(biased.largest > 0.001 / (0.1 * std::sqrt(samples / unit_samples)));
  CHECK(biased.quiet_share == Approx(0.1));
  CHECK(biased.quiet_difference == Approx(0.0005).epsilon(1e-3));
}

TEST_CASE("unbiased differences have no systematic part") {
  const PrecisionError fair = precision_error(known_pairs(0.1, 0, 0.002));
  CHECK(fair.systematic < 0.02);
  CHECK(fair.systematic_most < 0.05);
  CHECK(std::abs(fair.mean.value) < 5 * fair.mean.standard_error); // a false alarm: 0.2% of seeds
  CHECK(fair.quiet_difference == 0);
  const PrecisionError same = precision_error(known_pairs(0.1, 0, 0));
  CHECK(same.difference < 1e-9);
  CHECK(same.largest < 1e-9);
}

TEST_CASE("float64 breaks even where the systematic error equals the noise that float32 saves") {
  CHECK(break_even_samples(1, 2) == Approx(unit_samples / 2));
  CHECK(break_even_samples(0.01, 10) == Approx(unit_samples * 0.9 * 1e4));
  CHECK(break_even_samples(0, 2) == std::numeric_limits<double>::infinity());
  CHECK(break_even_samples(0.1, 0.9) == 0);
}
