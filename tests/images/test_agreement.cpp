// agreement(): its false-alarm rate, and that it detects differences.
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "images/agreement.h"

using namespace phlux::test;

namespace {

// An image of 8x8 pixels with mean 1 and a standard error of 1%, one channel of one pixel shifted by `shift`
// of those.
Estimate noisy(std::mt19937& random, double shift) {
  std::normal_distribution<double> normal;
  Estimate image = closed_form(8, 8, std::vector<Channels>(64));
  for (Channels& mean : image.mean)
    for (double& value : mean) value = 1 + 0.01 * normal(random);
  for (Channels& variance : image.variance) variance.fill(1e-4);
  image.mean[37][1] += 0.01 * shift;
  return image;
}

} // namespace

TEST_CASE("images with the same expectation agree, but for the rate of false alarms") {
  std::mt19937 random(1);
  const Estimate exact = closed_form(8, 8, std::vector<Channels>(64, {1, 1, 1}));
  int alarms = 0;
  for (int i = 0; i < 2000; ++i) alarms += !agreement(noisy(random, 0), exact, 0).agrees;
  CHECK(alarms <= 3); // 0.2 are expected; 4 or more: a chance of 6e-5
}

TEST_CASE("a pixel that is wrong, a bias of all pixels and what is not finite are found") {
  std::mt19937 random(2);
  const Estimate exact = closed_form(8, 8, std::vector<Channels>(64, {1, 1, 1}));
  const Agreement one_pixel = agreement(noisy(random, 12), exact);
  CHECK_FALSE(one_pixel.agrees);
  CHECK_THAT(one_pixel.message, Catch::Contains("channel G of pixel (5, 4)"));

  Estimate biased = noisy(random, 0);
  for (Channels& mean : biased.mean) mean[2] += 0.01; // one standard error of a pixel, eight of the mean
  const Agreement all_pixels = agreement(biased, exact);
  CHECK_FALSE(all_pixels.agrees);
  CHECK_THAT(all_pixels.message, Catch::Contains("the mean of channel B"));

  Estimate broken = exact;
  broken.mean[3][0] = std::nan("");
  CHECK_FALSE(agreement(broken, exact).agrees);
  CHECK_FALSE(agreement(exact, closed_form(4, 16, exact.mean)).agrees);
}

TEST_CASE("rounding is no difference, more than that without noise is") {
  const Estimate exact = closed_form(1, 1, {{1, 1, 1}});
  CHECK(agreement(closed_form(1, 1, {{1, 1 + 1e-5, 1}}), exact).agrees);
  CHECK_FALSE(agreement(closed_form(1, 1, {{1, 1 + 1e-4, 1}}), exact).agrees);
}

TEST_CASE("tiles hold means of pixels and the variances of those") {
  Estimate image = closed_form(4, 2, std::vector<Channels>(8, {1, 2, 3}));
  for (Channels& variance : image.variance) variance.fill(0.4);
  image.mean[1] = {5, 2, 3};
  const Estimate result = tiles(image, 2);
  CHECK(result.width == 2);
  CHECK(result.height == 1);
  CHECK(result.mean[0][0] == Approx(2));
  CHECK(result.mean[1][0] == Approx(1));
  CHECK(result.variance[0][2] == Approx(0.1));
}
