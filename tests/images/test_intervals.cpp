// Coverage of the 95% intervals from the variances of the film.
#include <cmath>

#include <catch2/catch.hpp>

#include "images/stability.h"
#include "measure/statistics.h"

using namespace phlux;
using namespace phlux::test;

namespace {

constexpr double normal = 1.96; // of 95%, in standard errors

// Share of the 95% intervals of all values that contain their mean. Images with different seeds have the same
// expectation.
double coverage(const std::vector<Estimate>& images, double interval) {
  int inside = 0, all = 0;
  for (std::size_t pixel = 0; pixel < images[0].mean.size(); ++pixel) {
    double mean = 0;
    for (const Estimate& image : images) mean += image.mean[pixel][1] / static_cast<double>(images.size());
    if (mean <= 0) continue;
    for (const Estimate& image : images) {
      inside += std::abs(image.mean[pixel][1] - mean) <= interval * std::sqrt(image.variance[pixel][1]);
      ++all;
    }
  }
  return static_cast<double>(inside) / all;
}

double coverage_of_seeds(const char* name, const Method& method, int samples, int seeds) {
  const scene::Scene scene = stability(name, {{"width", "6"}, {"height", "4"}});
  std::vector<Estimate> images;
  for (int seed = 0; seed < seeds; ++seed)
    images.push_back(image_by(method, scene, samples, static_cast<std::uint64_t>(seed)));
  return coverage(images, normal);
}

// Coverage for 400 streams of random numbers: pixels that all see the same point, equivalent to seeds in a
// single render.
double coverage_of_streams(const char* name, const Method& method, int samples, double interval = normal) {
  scene::Scene scene = stability(name, {{"width", "20"}, {"height", "20"}});
  scene.camera.tan_half_fov_x *= 1e-4;
  const Estimate image = image_by(method, scene, samples, 1);
  std::vector<Estimate> pixels;
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    pixels.push_back({1, 1, {image.mean[i]}, {image.variance[i]}});
  return coverage(pixels, interval);
}

void check_coverage(double coverage) {
  CHECK(coverage > 0.93);
  CHECK(coverage < 0.97);
}

} // namespace

// With a coverage of 95%, 400 intervals are outside these bounds with probability 7%, and 24 pixels of 60
// seeds with probability 1e-3. The seeds are fixed.
TEST_CASE("the 95% interval holds the right value 93% to 97% of the time") {
  check_coverage(coverage_of_streams("narrow-view", path, 512));
  check_coverage(coverage_of_streams("near-light", path, 512));
  check_coverage(coverage_of_streams("tiny-light", bidir, 512));
  check_coverage(coverage_of_seeds("caustic", light, 1024, 60));
}

// 512 samples are as 24 equal sets: 1.96 standard errors hold in 94% of the cases, and Student's t in 95%.
TEST_CASE("the 95% interval of point sets holds the right value 93% to 97% of the time") {
  const double interval = measure::student_t(0.05, 23.0);
  check_coverage(coverage_of_streams("narrow-view", path_sobol, 512, interval));
  check_coverage(coverage_of_streams("near-light", path_lattice, 512, interval));
  check_coverage(coverage_of_streams("tiny-light", bidir_lattice, 512, interval));
}

// An incomplete last set too.
TEST_CASE("point sets have the mean of independent samples, and less noise") {
  const scene::Scene scene = stability("near-light", {{"width", "6"}, {"height", "4"}});
  for (const auto& [sets, independent] : {std::pair(path_sobol, path), std::pair(path_lattice, path),
                                          std::pair(bidir_sobol, bidir), std::pair(bidir_lattice, bidir)}) {
    CAPTURE(name_of(sets));
    const Repeated by_sets = repeated(scene, sets, settings_for(1000)),
                   reference = repeated(scene, independent, settings_for(1000));
    check_methods(by_sets, reference);
    double of_sets = 0.0, of_independent = 0.0;
    for (std::size_t pixel = 0; pixel < reference.image.mean.size(); ++pixel) {
      of_sets += by_sets.image.variance[pixel][1];
      of_independent += reference.image.variance[pixel][1];
    }
    CHECK(of_sets < (sets.integrator == "path" ? 0.5 : 0.9) * of_independent);
  }
}

TEST_CASE("the 95% interval holds the right value for 93% to 97% of 400 seeds", "[.long]") {
  check_coverage(coverage_of_seeds("narrow-view", path, 512, 400));
  check_coverage(coverage_of_seeds("corner", bidir, 512, 400));
  check_coverage(coverage_of_seeds("caustic", light, 1024, 400));
}
