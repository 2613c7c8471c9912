// Detection of error estimates that cannot be trusted.
#include "film/reliability.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

using phlux::film::BlockSum;
using phlux::film::ContributionSizes;
using phlux::film::Film;
using phlux::film::Reliability;
using phlux::film::reliability_map;
using phlux::film::reliability_of;
using phlux::film::TileMeans;

namespace {

constexpr int side = 32, block_samples = 16;

using Draw = std::function<double(std::size_t pixel)>;

BlockSum block_of(std::size_t pixel, const Draw& draw) {
  BlockSum block{};
  for (int i = 0; i < block_samples; ++i) {
    const auto x = static_cast<float>(draw(pixel));
    for (int channel = 0; channel < 3; ++channel) {
      block.radiance[channel] += x;
      block.radiance_squared[channel] += x * x;
    }
  }
  return block;
}

Film film_of(int samples, const Draw& draw) {
  Film film(side, side);
  for (int i = 0; i < samples / block_samples; ++i)
    for (std::size_t pixel = 0; pixel < side * side; ++pixel)
      film.add(pixel, block_of(pixel, draw), block_samples);
  return film;
}

// Each path splats value() to a random pixel.
Film film_of_splats(int paths_per_pixel, const std::function<double()>& value) {
  std::mt19937 random(5);
  Film film(side, side);
  film.use_splats();
  for (int path = 0; path < paths_per_pixel * side * side; ++path) {
    film.add_splatting_paths(1);
    const double x = value();
    film.add_splat(random() % (side * side), {x, x, x}, path % Film::sized_one_in == 0);
  }
  return film;
}

// Share of the pixels that are not black whose 95% intervals hold the mean.
double coverage(const Film& film, const Draw& mean) {
  double held = 0.0, lit = 0.0;
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    if (!(mean(pixel) > 0.0)) continue;
    const double error = std::sqrt(film.variance_of_mean(pixel)[0]);
    held += std::abs(film.mean(pixel)[0] - mean(pixel)) <= 1.96 * error;
    lit += 1.0;
  }
  return held / lit;
}

double pareto(std::mt19937& random, double index) {
  return std::pow(std::uniform_real_distribution<double>(1e-12, 1.0)(random), -1.0 / index);
}

} // namespace

TEST_CASE("What takes long for a large film reports its progress, and ends by what that throws") {
  const Film film(64, 3 * TileMeans::tile_edge + 1);
  std::vector<double> shares;
  const auto note = [&](double done) { shares.push_back(done); };
  static_cast<void>(reliability_of(film, note));
  CHECK(shares.size() == 4); // rows of tiles
  static_cast<void>(film.relative_error(note));
  CHECK(shares.size() == 5);
  CHECK(std::ranges::all_of(shares, [](double done) { return done >= 0.0 && done < 1.0; }));
  struct Ended {};
  const auto end = [](double) { throw Ended(); };
  CHECK_THROWS_AS(reliability_of(film, end), Ended);
  CHECK_THROWS_AS(film.relative_error(end), Ended);
}

TEST_CASE("Even noise is trusted, and its figures are those of its distribution") {
  std::mt19937 random(1);
  std::exponential_distribution<double> noise(0.5); // relative variance 1, kurtosis 9
  const Film film = film_of(256, [&](std::size_t) { return noise(random); });
  const Reliability r = reliability_of(film);
  CAPTURE(r.reasons);
  CHECK(r.trusted);
  CHECK(r.variance == Approx(1.0).epsilon(0.08)); // the larger of two noisy means is a little too large
  // (kurtosis - 1) / samples, of the image and of a pixel
  CHECK(r.variance_error == Approx(std::sqrt(8.0 / (256.0 * side * side))).epsilon(0.1));
  // Exponential noise has the squared skewness 4 and the excess kurtosis 6: the coverage that 256 samples
  // lose is (4 * 1.08 - 6 * .07) * .229 / 256.
  CHECK(r.coverage == Approx(0.946).margin(0.006));
  CHECK(r.relative_standard_error == Approx(1.0 / 16).epsilon(0.1));
  for (const float pixel : reliability_map(film)) CHECK(pixel == Approx(0.94).margin(0.05));
}

TEST_CASE("The reliability of splats is that of samples") {
  std::mt19937 random(2);
  const Reliability even = reliability_of(film_of_splats(256, [] { return 1.0; }));
  CAPTURE(even.reasons);
  CHECK(even.trusted);
  CHECK(even.variance == Approx(1.0).epsilon(0.08)); // one path in `pixels` reaches a given pixel
  const Reliability heavy = reliability_of(film_of_splats(256, [&] { return pareto(random, 1.2); }));
  CHECK_FALSE(heavy.trusted);
  REQUIRE(heavy.tail_index);
  CHECK(*heavy.tail_index == Approx(1.2).epsilon(0.2));
}

TEST_CASE("An infinite variance is not trusted, whatever the number of samples") {
  for (const int samples : {64, 1024}) {
    std::mt19937 random(3);
    const Reliability r = reliability_of(film_of(samples, [&](std::size_t) { return pareto(random, 1.5); }));
    CAPTURE(samples, r.tail_index.value_or(0.0), r.variance_error, r.coverage);
    CHECK_FALSE(r.trusted);
    REQUIRE(r.tail_index);
    CHECK(*r.tail_index == Approx(1.5).epsilon(0.25));
  }
}

TEST_CASE("The predicted coverage is that of the intervals") {
  std::mt19937 random(9);
  std::exponential_distribution<double> noise;
  const auto hit = [&](double rate) { return std::bernoulli_distribution(rate)(random) ? 1.0 / rate : 0.0; };
  const auto everywhere = [](double mean) { return [mean](std::size_t) { return mean; }; };
  const auto one_in = [](std::size_t pixels, double mean, double otherwise) {
    return [=](std::size_t pixel) { return pixel % pixels == 0 ? mean : otherwise; };
  };
  struct Case {
    const char* name;
    bool trusted;
    int samples;
    Draw draw, mean;
  };
  const Case cases[] = {
      {"even noise", true, 64, [&](std::size_t) { return noise(random); }, everywhere(1)},
      {"half a hit in a pixel", false, 64, [&](std::size_t) { return hit(1.0 / 128); }, everywhere(1)},
      {"two hits in a pixel", false, 64, [&](std::size_t) { return hit(1.0 / 32); }, everywhere(1)},
      {"eight hits in a pixel", true, 64, [&](std::size_t) { return hit(1.0 / 8); }, everywhere(1)},
      {"half of the light is rare", false, 64, [&](std::size_t) { return noise(random) + hit(1.0 / 2048); },
       everywhere(2)},
      {"half of the light is rare, one block", false, 16,
       [&](std::size_t) { return noise(random) + hit(1.0 / 512); }, everywhere(2)},
      {"a twentieth of the light is rare", true, 64,
       [&](std::size_t) { return noise(random) + hit(1.0 / 4096) / 20.0; }, everywhere(1.05)},
      {"an eighth of the pixels is noisy", true, 64,
       [&](std::size_t pixel) { return pixel % 8 == 0 ? hit(0.5) : 1.0 + 0.01 * noise(random); },
       one_in(8, 1, 1.01)},
      {"half of the pixels is black", true, 64,
       [&](std::size_t pixel) { return pixel % 2 == 0 ? noise(random) + hit(1e-5) / 100.0 : 0.0; },
       one_in(2, 1.01, 0)},
  };
  for (const Case& of : cases) {
    CAPTURE(of.name);
    const Film film = film_of(of.samples, of.draw);
    const Reliability r = reliability_of(film);
    CHECK(r.coverage == Approx(coverage(film, of.mean)).margin(0.1));
    CHECK(r.trusted == of.trusted);
  }
}

TEST_CASE("Rare events are not trusted before pixels have met some of them") {
  const auto rare = [](int samples) {
    std::mt19937 random(4);
    std::bernoulli_distribution hit(1.0 / 256);
    return reliability_of(film_of(samples, [&](std::size_t) { return hit(random) ? 256.0 : 0.0; }));
  };
  const Reliability few = rare(64), many = rare(4096);
  CHECK_FALSE(few.trusted);
  CHECK(few.coverage == Approx(1.0 - std::exp(-0.25)).margin(0.05)); // a quarter of a hit per pixel
  CHECK(few.relative_standard_error == Approx(2.0).epsilon(0.35));
  CAPTURE(many.reasons);
  CHECK(many.trusted); // 16 hits per pixel
  CHECK(many.coverage == Approx(0.95 - 0.23 / 16).margin(0.01));
}

TEST_CASE("A bright lamp's edge does not pass for a firefly") {
  std::mt19937 random(6);
  std::exponential_distribution<double> noise(0.5);
  std::bernoulli_distribution covered(0.5);
  const Film film = film_of(256, [&](std::size_t pixel) {
    return pixel == 100 ? (covered(random) ? 1000.0 : 0.0) : pixel == 101 ? 1000.0 : noise(random);
  });
  const Reliability r = reliability_of(film);
  CAPTURE(r.reasons);
  CHECK(r.trusted);
  CHECK(r.top_share < 0.2);
}

TEST_CASE("What says nothing is not trusted: few samples, black, all alike") {
  CHECK_FALSE(reliability_of(Film(side, side)).trusted);
  CHECK_FALSE(reliability_of(film_of(64, [](std::size_t) { return 0.0; })).trusted);
  const Reliability alike = reliability_of(film_of(64, [](std::size_t) { return 2.0; }));
  CHECK_FALSE(alike.trusted);
  CHECK(alike.variance == 0.0);
  for (const float pixel : reliability_map(Film(side, side))) CHECK(pixel == 0.0F);
}

TEST_CASE("The worst tile is named") {
  std::mt19937 random(7);
  std::exponential_distribution<double> noise(0.5);
  std::bernoulli_distribution hit(1e-3);
  const Film film = film_of(64, [&](std::size_t pixel) {
    const bool in_tile = pixel % side >= 16 && pixel / side < 16;
    return in_tile && hit(random) ? 1e4 : noise(random);
  });
  const Reliability r = reliability_of(film);
  CHECK(r.worst_x == 24);
  CHECK(r.worst_y == 8);
  CHECK(r.worst_share > 0.5);
}

TEST_CASE("Sizes: the share of the largest and the index of the tail") {
  ContributionSizes sizes;
  CHECK(sizes.largest() == 0.0);
  CHECK(sizes.share_of_largest(1) == 0.0);
  CHECK_FALSE(sizes.tail_index(1));
  for (int i = 0; i < 999; ++i) sizes.add(0.0);
  sizes.add(4.0);
  CHECK(sizes.share_of_largest(1) == 1.0);
  CHECK_FALSE(sizes.tail_index(1)); // all of equal size
  sizes.add(1e300);                 // above the largest float
  CHECK(std::isfinite(sizes.largest()));
  ContributionSizes tail;
  std::mt19937 random(8);
  for (int i = 0; i < 100'000; ++i) tail.add(pareto(random, 3.0));
  REQUIRE(tail.tail_index(500));
  CHECK(*tail.tail_index(500) == Approx(3.0).epsilon(0.15)); // 3 / sqrt(500) is 4.5% of it
}

TEST_CASE("Every pixel has its tile") {
  const TileMeans tiles(37, 21);
  CHECK(tiles.count() == 6);
  for (std::size_t y = 0; y < 21; ++y)
    for (std::size_t x = 0; x < 37; ++x) CHECK(tiles.tile_of(y * 37 + x) == y / 16 * 3 + x / 16);
  CHECK(TileMeans(1, 16384).tile_of(16383) == 1023);
}
