// With random seeds, each statistical test here would fail with probability 1e-3.
#include <cmath>
#include <functional>
#include <random>

#include <catch2/catch.hpp>

#include "bench/common/methods/image_estimates.h"
#include "files/compare.h"

using namespace phlux::bench;

namespace {

constexpr std::size_t repeats = 10;
constexpr double t_95 = 2.2622; // Student's, two-sided, 9 degrees of freedom (Abramowitz and Stegun, 26.10)

Reference constant(std::size_t values, double radiance) {
  return exact_reference(std::vector<double>(values, radiance));
}

Estimate variance_of(const std::vector<ImageEstimate>& images, const Reference& reference) {
  return mean_of(variances_per_sample(images, reference));
}

// An image whose values are means of `samples` random numbers.
ImageEstimate image_of(std::size_t pixels, int samples, const std::function<double()>& draw) {
  ImageEstimate image;
  for (std::size_t value = 0; value < 3 * pixels; ++value) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) sum += draw();
    image.radiance.push_back(sum / samples);
  }
  image.samples.assign(pixels, samples);
  return image;
}

std::vector<ImageEstimate> images_of(std::size_t count, std::size_t pixels, int samples,
                                     const std::function<double()>& draw) {
  std::vector<ImageEstimate> images;
  for (std::size_t i = 0; i < count; ++i) images.push_back(image_of(pixels, samples, draw));
  return images;
}

// Exponentially distributed: mean and standard deviation `mean`.
std::function<double()> exponential(std::mt19937& generator, double mean) {
  return [&generator, mean] { return std::exponential_distribution<double>(1 / mean)(generator); };
}

// x^(-3/2) P(X > x), from 1: a mean of 3 and an infinite variance.
std::function<double()> heavy_tailed(std::mt19937& generator) {
  return [&generator] {
    return std::pow(1 - std::uniform_real_distribution<double>(0, 1)(generator), -1 / 1.5);
  };
}

// Two-sided test of a binomial rate with significance level 1e-3, by the normal approximation.
bool rate_holds(int successes, int n, double rate) {
  return std::abs(successes - n * rate) < 3.29 * std::sqrt(n * rate * (1 - rate)) + 0.5;
}

} // namespace

TEST_CASE("The relative MSE is that of phlux compare") {
  std::mt19937 generator(1);
  const ImageEstimate a = image_of(200, 4, exponential(generator, 0.3)),
                      b = image_of(200, 9, exponential(generator, 0.3));
  const auto image = [](const ImageEstimate& estimate) {
    phlux::files::Image result{.width = 20, .height = 10, .channels = {}, .info = {}};
    const std::array<const char*, 3> names = {"R", "G", "B"};
    for (std::size_t value = 0; value < estimate.radiance.size(); ++value)
      result.channels[names[value % 3]].push_back(static_cast<float>(estimate.radiance[value]));
    return result;
  };
  CHECK(relative_mse(a, exact_reference(b.radiance)) ==
        Approx(phlux::files::compare(image(a), image(b), "a", "b").relmse).epsilon(1e-5));
}

TEST_CASE("The variance per sample does not depend on the number of samples per image") {
  std::mt19937 generator(2);
  const Reference reference = constant(300, 0.5);
  const double expected = 0.25 / (0.25 + 1e-4);
  std::vector<ImageEstimate> images;
  for (const int samples : {1, 2, 3, 5, 8, 13, 21, 34, 55, 89})
    images.push_back(image_of(100, samples, exponential(generator, 0.5)));
  const Estimate variance = variance_of(images, reference);
  CHECK(p_value(variance, expected) > 1e-3);
  CHECK(variance.standard_error < 0.15 * expected);
  // The variance then explains the whole error of the pooled image.
  CHECK(p_value(unexplained_mse(images, reference), 0) > 1e-3);
}

TEST_CASE("Confidence intervals have the coverage of Student's t") {
  constexpr int experiments = 400;
  constexpr std::size_t pixels = 64;
  std::mt19937 generator(3);
  const Reference reference = constant(3 * pixels, 2.0);
  int means = 0, variances = 0, false_alarms = 0;
  for (int i = 0; i < experiments; ++i) {
    const auto images = images_of(repeats, pixels, 4, exponential(generator, 2.0));
    const auto covers = [](const Estimate& figure, double truth) {
      return std::abs(figure.value - truth) < t_95 * figure.standard_error;
    };
    means += covers(mean_of(image_means(images)), 2.0) ? 1 : 0;
    variances += covers(variance_of(images, reference), 4.0 / 4.0001) ? 1 : 0;
    false_alarms += p_value_above(unexplained_mse(images, reference), 0) < 0.05 ? 1 : 0;
  }
  CAPTURE(means, variances, false_alarms);
  CHECK(rate_holds(means, experiments, 0.95));
  CHECK(rate_holds(variances, experiments, 0.95));
  CHECK(false_alarms < 0.05 * experiments + 3.29 * std::sqrt(experiments * 0.05 * 0.95));
}

// The noise of the reference is as large as that of the images. Ignoring it would make every experiment a
// false alarm.
TEST_CASE("The noise of the reference is no bias") {
  constexpr int experiments = 200;
  constexpr std::size_t width = 12;
  std::mt19937 generator(8);
  int pixels = 0, means = 0;
  for (int i = 0; i < experiments; ++i) {
    const auto draw = exponential(generator, 0.5);
    const auto images = images_of(repeats, width * width, 4, draw),
               others = images_of(8, width * width, 4, draw);
    const Reference reference = pooled_reference(others, width);
    pixels += p_value_above(unexplained_mse(images, reference), 0) < 0.05 ? 1 : 0;
    means +=
        p_value(difference_of(mean_of(image_means(images)), mean_of(image_means(others))), 0) < 0.05 ? 1 : 0;
    if (i == 0) CHECK(reference.relmse() == Approx(1.0 / 32).epsilon(0.2));
  }
  CAPTURE(pixels, means);
  CHECK(pixels < 0.05 * experiments + 3.29 * std::sqrt(experiments * 0.05 * 0.95));
  CHECK(rate_holds(means, experiments, 0.05));
}

TEST_CASE("A pixel that is bright by chance does not lower its own weight, and a bright object does") {
  constexpr std::size_t width = 20, middle = 10 * width + 10;
  std::vector<double> radiance(3 * width * width, 1.0), variance(radiance.size(), 1e-6);
  for (std::size_t value = 3 * middle; value < 3 * middle + 3; ++value) radiance[value] = 30;
  CHECK(noisy_reference(radiance, variance, width).weights[3 * middle] == Approx(1.0 / 900).epsilon(0.01));
  for (std::size_t value = 3 * middle; value < 3 * middle + 3; ++value) variance[value] = 900;
  CHECK(noisy_reference(radiance, variance, width).weights[3 * middle] == Approx(0.5).epsilon(0.2));
  CHECK(noisy_reference(radiance, variance, width).weights[0] == Approx(1.0).epsilon(0.01));
}

TEST_CASE("A bias appears in the unexplained MSE and in the mean") {
  std::mt19937 generator(4);
  const Reference reference = constant(300, 2.0);
  const auto images = images_of(repeats, 100, 50, exponential(generator, 1.9)); // 5% too dark
  const Estimate unexplained = unexplained_mse(images, reference);
  CHECK(p_value_above(unexplained, 0) < 1e-4);
  CHECK(p_value(unexplained, 0.01 / 4.0001) > 1e-3);
  CHECK(p_value(mean_of(image_means(images)), 2.0) < 1e-4);
  CHECK(p_value(mean_of(image_means(images)), 1.9) > 1e-3);
}

TEST_CASE("The pooled image weights images by their samples") {
  const std::vector<ImageEstimate> images = {{{1, 1, 1}, {1}}, {{4, 4, 4}, {3}}};
  const ImageEstimate image = pooled(images);
  CHECK(image.radiance == std::vector<double>{3.25, 3.25, 3.25});
  CHECK(image.samples == std::vector<double>{4});
}

TEST_CASE("The top share is near 1 if one sample dominates the error") {
  std::mt19937 generator(5);
  const Reference reference = constant(3 * 5000, 1.0);
  std::normal_distribution<double> normal(1, 0.5);
  auto images = images_of(2, 5000, 1, [&] { return normal(generator); });
  // Of sums of three squares of normal deviates: chi-square with 3 degrees of freedom beyond its 0.999
  // quantile, 16.27, holds 0.0061 of the sum.
  CHECK(top_share(images, reference) == Approx(0.0061).margin(0.001));
  images[0].radiance[77] = 1e4;
  CHECK(top_share(images, reference) > 0.99);
  const std::vector<ImageEstimate> exact = {{reference.radiance, std::vector<double>(5000, 1)}};
  CHECK(top_share(exact, reference) == 0);
}

TEST_CASE("An infinite variance grows with the number of samples, a finite one does not") {
  std::mt19937 generator(6);
  const Reference reference = constant(3 * 200, 3.0);
  const auto growth = [&](const std::function<double()>& draw) {
    return log_growth(variances_per_sample(images_of(repeats, 200, 100, draw), reference),
                      variances_per_sample(images_of(repeats, 200, 1, draw), reference));
  };
  CHECK(p_value(growth(exponential(generator, 3.0)), 0) > 1e-3);
  std::vector<double> growths;
  for (int i = 0; i < 15; ++i) growths.push_back(growth(heavy_tailed(generator)).value);
  std::ranges::nth_element(growths, growths.begin() + 7);
  CHECK(growths[7] > std::log(2.0));
}

TEST_CASE("An infinite variance is dominated by few samples and keeps a large standard error") {
  std::mt19937 generator(7);
  const Reference reference = constant(3 * 200, 3.0);
  int dominated = 0, uncertain = 0, well_known = 0;
  for (int i = 0; i < 15; ++i) {
    const Estimate heavy = variance_of(images_of(repeats, 200, 100, heavy_tailed(generator)), reference);
    uncertain += heavy.standard_error > 0.1 * heavy.value ? 1 : 0;
    dominated += top_share(images_of(repeats, 200, 1, heavy_tailed(generator)), reference) > 0.3 ? 1 : 0;
    const Estimate light = variance_of(images_of(repeats, 200, 100, exponential(generator, 3.0)), reference);
    well_known += light.standard_error < 0.1 * light.value ? 1 : 0;
  }
  CHECK(uncertain >= 12);
  CHECK(dominated >= 12);
  CHECK(well_known == 15);
}

TEST_CASE("P-values are those of Student's t distribution") {
  CHECK(p_value({1 + t_95, 1, 9}, 1) == Approx(0.05).epsilon(1e-4));
  CHECK(p_value({1 - t_95, 1, 9}, 1) == Approx(0.05).epsilon(1e-4));
  CHECK(p_value_above({1 + t_95, 1, 9}, 1) == Approx(0.025).epsilon(1e-4));
  CHECK(p_value_above({1 - t_95, 1, 9}, 1) == Approx(0.975).epsilon(1e-4));
  CHECK(p_value({1.96, 1}, 0) == Approx(0.05).epsilon(1e-3)); // exact: normally distributed
  CHECK(p_value({1, 0}, 1) == 1);
  CHECK(p_value({2, 0}, 1) == 0);
}

TEST_CASE("The degrees of freedom of a difference are Welch's") {
  const Estimate even = difference_of({3, 0.5, 7}, {1, 0.5, 7});
  CHECK(even.value == 2);
  CHECK(even.standard_error == Approx(std::sqrt(0.5)));
  CHECK(even.degrees == Approx(14));
  CHECK(difference_of({3, 0.5, 7}, {1, 1e-9, 3}).degrees == Approx(7));
  CHECK(difference_of({3, 0.5, 7}, {1, 0}).degrees == Approx(7)); // an exact value
}
