#include "film/film.h"

#include "film/reliability.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

using phlux::film::BlockSum;
using phlux::film::Film;

namespace {

// Sums of one block in float32, as on a device.
BlockSum sum_block(const std::vector<float>& samples) {
  BlockSum block{};
  for (const float x : samples)
    for (int channel = 0; channel < 3; ++channel) {
      block.radiance[channel] += x;
      block.radiance_squared[channel] += x * x;
    }
  return block;
}

// Adds `blocks` blocks of samples from `next` to pixel 0; returns all samples.
template<class Draw>
std::vector<float> fill(Film& film, int blocks, int block_length, Draw next) {
  std::vector<float> all, block(static_cast<std::size_t>(block_length));
  for (int i = 0; i < blocks; ++i) {
    for (float& x : block) x = next();
    film.add(0, sum_block(block), static_cast<std::uint32_t>(block_length));
    all.insert(all.end(), block.begin(), block.end());
  }
  return all;
}

double two_pass_mean(const std::vector<float>& samples) {
  double sum = 0.0;
  for (const float x : samples) sum += x;
  return sum / static_cast<double>(samples.size());
}

double two_pass_variance_of_mean(const std::vector<float>& samples) {
  const double mean = two_pass_mean(samples), n = static_cast<double>(samples.size());
  double squares = 0.0;
  for (const float x : samples) squares += (x - mean) * (x - mean);
  return squares / (n - 1.0) / n;
}

} // namespace

TEST_CASE("A film begins black, without samples") {
  const Film film(3, 2);
  CHECK(film.pixels().size() == 6);
  CHECK(film.samples_per_pixel() == 0.0);
  CHECK(film.mean(5) == std::array<double, 3>{});
  CHECK(film.variance_of_mean(5) == std::array<double, 3>{});
  CHECK(film.relative_variance() == 0.0);
  CHECK(film.relative_standard_error() == std::numeric_limits<double>::infinity());
}

TEST_CASE("Blocks add up per pixel and channel") {
  Film film(2, 1);
  film.add(0, {{1.0F, 2.0F, 3.0F}, {1.0F, 4.0F, 9.0F}}, 1);
  film.add(0, {{3.0F, 2.0F, 0.0F}, {9.0F, 4.0F, 0.0F}}, 1);
  CHECK(film.mean(0) == std::array{2.0, 2.0, 1.5});
  CHECK(film.variance_of_mean(0) == std::array{1.0, 0.0, 2.25}); // (x1 - x2)^2 / 4
  CHECK(film.mean(1) == std::array<double, 3>{});
  CHECK(film.samples_per_pixel() == 1.0);
  CHECK(std::isinf(film.relative_standard_error())); // pixel 1 has no samples
  CHECK(film.relative_variance() == Approx((2.0 / 4.0 + 0.0 + 4.5 / 2.25) / 3.0));
}

// Four blocks of 1, 1, 2 and 4 samples with sums 3, 1, 6 and 4: mean 14 / 8, squared deviations of the sums
// 1.25^2 + .75^2 + 2.5^2 + 3^2 over 8^2 - (1 + 1 + 4 + 16).
TEST_CASE("The variance of dependent samples is that of the sums of blocks") {
  Film film(1, 1);
  film.use_dependent_samples();
  film.add(0, {{3, 3, 0}, {9, 9, 0}}, 1);
  CHECK(!film.has_variance());
  film.add(0, {{1, 3, 0}, {1, 9, 0}}, 1);
  CHECK(film.has_variance());
  film.add(0, {{6, 6, 0}, {18, 18, 0}}, 2);
  film.add(0, {{4, 12, 0}, {100, 36, 0}}, 4);
  CHECK(film.mean(0)[0] == 14.0 / 8.0);
  CHECK(film.variance_of_mean(0)[0] == Approx((1.5625 + 0.5625 + 6.25 + 9.0) / 42.0));
  CHECK(film.variance_of_mean(0)[1] == 0.0); // every sample is 3
  CHECK(film.variance_of_mean(0)[2] == 0.0);
}

TEST_CASE("Variance equals the float64 two-pass formula") {
  std::mt19937 random(7);
  SECTION("noise of the order of the mean, 1e6 samples") {
    Film film(1, 1);
    std::exponential_distribution<float> distribution(2.0F);
    const std::vector<float> samples = fill(film, 15625, 64, [&] { return distribution(random); });
    CHECK(film.mean(0)[0] == Approx(two_pass_mean(samples)).epsilon(1e-7));
    CHECK(film.variance_of_mean(0)[1] == Approx(two_pass_variance_of_mean(samples)).epsilon(1e-6));
    CHECK(film.relative_variance() == Approx(1.0).epsilon(0.02)); // of an exponential distribution
    CHECK(film.relative_standard_error() == Approx(1e-3).epsilon(0.01));
  }
  SECTION("rare bright samples") {
    Film film(1, 1);
    std::uniform_real_distribution<float> distribution;
    const std::vector<float> samples =
        fill(film, 4000, 64, [&] { return distribution(random) < 1e-3F ? 1e4F : 0.01F; });
    CHECK(film.variance_of_mean(0)[2] == Approx(two_pass_variance_of_mean(samples)).epsilon(1e-6));
  }
  SECTION("noise of 1% of the mean: what float32 squares leave of it") {
    Film film(1, 1);
    std::normal_distribution<float> distribution(1.0F, 0.01F);
    const std::vector<float> samples = fill(film, 4000, 64, [&] { return distribution(random); });
    CHECK(film.variance_of_mean(0)[0] == Approx(two_pass_variance_of_mean(samples)).epsilon(0.01));
  }
}

// Pixels of radiance 1, 0 with noise of mean 0, and 0 without samples other than 0.
TEST_CASE("Errors of signed contributions are relative to at least the mean of the image") {
  Film film(3, 1);
  for (const float value : {0.75F, 1.25F})
    film.add(0, {{value, value, value}, {value * value, value * value, value * value}}, 1);
  for (const float value : {0.125F, -0.1240234375F})
    film.add(1, {{value, value, value}, {value * value, value * value, value * value}}, 1);
  for (int sample = 0; sample < 2; ++sample) film.add(2, {}, 1);
  const double error0 = 0.25, error1 = (0.125 + 0.1240234375) / 2.0;
  const double mean1 = (0.125 - 0.1240234375) / 2.0, image = (1.0 + mean1) / 3.0;
  CHECK(film.relative_standard_error() == Approx((error0 + error1 / mean1) / 2.0)); // 128, for one bad pixel
  film.use_signed_contributions();
  CHECK(film.relative_standard_error() == Approx((error0 + error1 / image) / 2.0));
  CHECK(phlux::film::reliability_of(film).relative_standard_error < 1.0);
}

TEST_CASE("Variance is never negative") {
  Film film(1, 1);
  for (const float value : {0.1F, 1.0F / 3.0F, 0.7F, 1e-20F, 3e18F}) {
    fill(film, 1000, 17, [&] { return value; });
    Film constant(1, 1);
    fill(constant, 1000, 17, [&] { return value; });
    CHECK(constant.variance_of_mean(0)[0] >= 0.0);
    CHECK(constant.relative_standard_error() >= 0.0);
    CHECK(constant.relative_standard_error() < 1e-4); // only rounding
  }
  CHECK(film.variance_of_mean(0)[0] > 0.0);
}

TEST_CASE("A mean does not stall where float32 sums do", "[exactness]") {
  // An average of 0.505. A float32 sum stops growing once half its spacing exceeds 0.505.
  constexpr std::uint32_t block_length = 250;
  const float value = 0.505F;
  const auto samples = GENERATE(std::uint64_t{1'000'000}, std::uint64_t{100'000'000});
  Film film(1, 1);
  const BlockSum block = sum_block(std::vector<float>(block_length, value));
  for (std::uint64_t n = 0; n < samples; n += block_length) film.add(0, block, block_length);
  CHECK(film.pixels()[0].samples == samples);
  CHECK(film.mean(0)[0] == Approx(static_cast<double>(value)).epsilon(block_length * 0x1p-24));

  // All blocks are equal, so the exact value is the mean of a block, up to float64 rounding.
  CHECK(film.mean(0)[0] == Approx(static_cast<double>(block.radiance[0]) / block_length).epsilon(1e-10));

  float stalled = 0.0F;
  for (std::uint64_t n = 0; n < samples; ++n) stalled += value;
  if (samples == 100'000'000) CHECK(stalled / 1e8F < 0.4F);
}

TEST_CASE("Two-valued samples have their closed-form variance at 1e8 samples", "[exactness]") {
  // Alternately 0 and 1: mean 1/2, variance of one sample n/(4(n-1)), of the mean 1/(4(n-1)); every float32
  // sum is exact.
  Film film(1, 1);
  constexpr std::uint32_t block_length = 1000;
  constexpr double sample_count = 1e8;
  const BlockSum block{{500.0F, 500.0F, 500.0F}, {500.0F, 500.0F, 500.0F}};
  for (int i = 0; i < 100'000; ++i) film.add(0, block, block_length);
  CHECK(film.mean(0)[0] == 0.5);
  CHECK(film.variance_of_mean(0)[0] == Approx(0.25 / (sample_count - 1.0)).epsilon(1e-12));
  CHECK(film.relative_variance() == Approx(sample_count / (sample_count - 1.0)).epsilon(1e-12));
  CHECK(film.relative_standard_error() == Approx(1.0 / std::sqrt(sample_count - 1.0)).epsilon(1e-12));
}

TEST_CASE("The unit of the sums changes radiances and no relative figure") {
  Film plain(1, 1), bright(1, 1);
  bright.set_unit(0x1p90);
  for (Film* film : {&plain, &bright}) film->add(0, {{4.0F, 2.0F, 1.0F}, {10.0F, 4.0F, 1.0F}}, 2);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    CHECK(bright.mean(0)[channel] == 0x1p90 * plain.mean(0)[channel]);
    CHECK(bright.variance_of_mean(0)[channel] == 0x1p180 * plain.variance_of_mean(0)[channel]);
  }
  CHECK(bright.relative_variance() == plain.relative_variance());
  CHECK(bright.relative_standard_error() == plain.relative_standard_error());
}

TEST_CASE("A film has a variance once every pixel has two samples") {
  Film film(2, 1);
  film.add(0, {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}}, 2);
  film.add(1, {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}}, 1);
  CHECK_FALSE(film.has_variance());
  film.add(1, {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}}, 1);
  CHECK(film.has_variance());
}

TEST_CASE("Black pixels count neither as exact nor as noisy") {
  Film film(2, 1);
  film.add(0, {{2.0F, 0.0F, 0.0F}, {4.0F, 0.0F, 0.0F}}, 2); // red: 0 and 2; green and blue: black
  film.add(1, {}, 2);
  CHECK(film.relative_standard_error() == Approx(1.0)); // variance of the mean 1, mean 1
  CHECK(film.relative_variance() == Approx(2.0));

  Film black(1, 1);
  black.add(0, {}, 2);
  CHECK(black.relative_standard_error() == 0.0);
}
