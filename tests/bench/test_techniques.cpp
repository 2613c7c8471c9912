#include "bench/techniques/techniques.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace phlux;
using namespace phlux::bench;
using Catch::Contains;

namespace {

constexpr std::size_t rounds = 10, pixels = 300;
const film::Technique hit{0, 2}, light_sample{1, 1};

ImageEstimate image_of(std::mt19937& generator, double mean, double deviation) {
  ImageEstimate image;
  for (std::size_t value = 0; value < 3 * pixels; ++value)
    image.radiance.push_back(std::normal_distribution<double>(mean, deviation)(generator));
  image.samples.assign(pixels, 1.0);
  return image;
}

ImageEstimate sum_of(ImageEstimate a, const ImageEstimate& b) {
  for (std::size_t i = 0; i < a.radiance.size(); ++i) a.radiance[i] += b.radiance[i];
  return a;
}

// An image of two independent techniques with these means and standard deviations.
TechniqueRounds two_techniques(double mean_a, double deviation_a, double mean_b, double deviation_b) {
  std::mt19937 generator(1);
  TechniqueRounds result;
  for (std::size_t round = 0; round < rounds; ++round) {
    const ImageEstimate a = image_of(generator, mean_a, deviation_a),
                        b = image_of(generator, mean_b, deviation_b);
    result.techniques[hit].weighted.push_back(a);
    result.techniques[hit].unweighted.push_back(a);
    result.techniques[light_sample].weighted.push_back(b);
    result.techniques[light_sample].unweighted.push_back(b);
    result.images.push_back(sum_of(a, b));
  }
  result.techniques[light_sample].rays = 1;
  result.rays = 4;
  return result;
}

const Reference ones = exact_reference(std::vector<double>(3 * pixels, 1.0));

} // namespace

// The standard error of a variance from 900 values and 10 rounds is 1.6% of it: 5 of them.
TEST_CASE("Shares of techniques: of the light, the variance and the rays") {
  const std::vector<TechniqueShare> shares = technique_shares(two_techniques(0.75, 1, 0.25, 2), ones);
  REQUIRE(shares.size() == 2);
  CHECK(shares[0].technique == light_sample);
  CHECK(shares[0].variance_share.value == Approx(0.8).epsilon(0.08));
  CHECK(shares[0].variance_share.value + shares[1].variance_share.value == Approx(1));
  CHECK(shares[0].variance.value == Approx(4).epsilon(0.08));
  CHECK(shares[1].variance.value == Approx(1).epsilon(0.08));
  CHECK(std::abs(shares[0].light.value - 0.25) < 5 * shares[0].light.standard_error);
  CHECK(shares[0].light.value + shares[1].light.value == Approx(1));
  CHECK(shares[0].ray_share == 0.25);
  CHECK(shares[1].ray_share == 0);
  const std::string answer = techniques_answer(shares);
  CHECK_THAT(answer, Contains("(1, 1) causes most, "));
  CHECK_THAT(answer, Contains("takes 25.0% of the rays"));
  CHECK_THAT(answer, !Contains("tied"));
}

TEST_CASE("Techniques of the same variance are tied") {
  const std::vector<TechniqueShare> shares = technique_shares(two_techniques(0.5, 1, 0.5, 1), ones);
  CHECK_THAT(techniques_answer(shares), Contains("; tied with (") && Contains("of the variance"));
}

TEST_CASE("The jackknife's standard error of a ratio is that of linear error propagation") {
  std::mt19937 generator(2);
  std::vector<double> a, b;
  for (int i = 0; i < 1000; ++i) {
    b.push_back(std::normal_distribution<double>(10, 1)(generator));
    a.push_back(3 * b.back() + std::normal_distribution<double>(0, 0.5)(generator));
  }
  const Estimate ratio = ratio_of(a, b);
  CHECK(std::abs(ratio.value - 3) < 5 * ratio.standard_error);
  CHECK(ratio.standard_error == Approx(0.5 / 10 / std::sqrt(1000)).epsilon(0.12)); // 5 standard errors
}
