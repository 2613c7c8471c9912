// The unweighted contribution of each technique.
#include <cmath>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "images/integrators.h"
#include "images/room.h"

using namespace phlux;
using namespace phlux::test;
using film::Technique;

namespace {

constexpr int edges = 4, renders = 16;

Render rendered(const std::string& integrator, std::uint64_t seed) {
  static const scene::Scene scene = room({"rectangle"});
  render::Settings with = settings_for(64, edges);
  with.integrator = integrator;
  with.techniques = true;
  with.seed = seed;
  return render_of(scene, with);
}

double mean_of(const std::vector<std::array<double, 3>>& pixels) {
  double sum = 0;
  for (const auto& pixel : pixels)
    for (const double value : pixel) sum += value;
  return sum / static_cast<double>(3 * pixels.size());
}

struct Mean {
  double value = 0, variance = 0;
};

Mean mean_over_renders(const std::vector<double>& values) {
  Mean mean;
  const double n = static_cast<double>(values.size());
  for (const double value : values) mean.value += value / n;
  for (const double value : values)
    mean.variance += (value - mean.value) * (value - mean.value) / (n - 1) / n;
  return mean;
}

} // namespace

TEST_CASE("the weighted images of all techniques add up to the image") {
  for (const std::string integrator : {"light", "bidir"}) {
    CAPTURE(integrator);
    Render image = rendered(integrator, 1);
    std::vector<std::array<double, 3>> sum(image.film.pixels().size());
    for (const auto& [technique, sums] : image.film.techniques()->sums()) {
      const auto one = image.film.technique_image(sums.weighted);
      for (std::size_t i = 0; i < sum.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel) sum[i][channel] += one[i][channel];
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      for (std::size_t channel = 0; channel < 3; ++channel)
        REQUIRE(sum[i][channel] == Approx(image.film.mean(i)[channel]).epsilon(1e-5).margin(1e-9));
  }
}

TEST_CASE("the contributions of techniques with light vertices are the shadow rays, occluded ones included") {
  for (const std::string integrator : {"light", "bidir"}) {
    CAPTURE(integrator);
    Render image = rendered(integrator, 3);
    std::uint64_t rays = 0;
    for (const auto& [technique, sums] : image.film.techniques()->sums())
      if (technique.light_vertices > 0) rays += sums.contributions;
    CHECK(rays == image.statistics.shadow_rays);
  }
}

TEST_CASE("bidir makes every path in every way") {
  Render image = rendered("bidir", 2);
  std::set<Technique> expected;
  for (int length = 1; length <= edges; ++length)
    for (int eye_vertices = 1; eye_vertices <= length + 1; ++eye_vertices)
      expected.insert({length + 1 - eye_vertices, eye_vertices});
  std::set<Technique> found;
  for (const auto& [technique, sums] : image.film.techniques()->sums()) found.insert(technique);
  CHECK(found == expected);
  CHECK(image.film.techniques()->left_out() == 0);
}

// Surfaces of the room are apart, so 1 / distance^2 of a connection is bounded and every technique has a
// finite variance. All comparisons together raise a false alarm with probability false_alarm_rate
// (Bonferroni).
TEST_CASE("techniques that make paths of one length agree without their weights") {
  std::map<Technique, std::vector<double>> means;
  for (int seed = 0; seed < renders; ++seed) {
    Render image = rendered("bidir", 100 + static_cast<std::uint64_t>(seed));
    for (const auto& [technique, sums] : image.film.techniques()->sums())
      means[technique].push_back(mean_of(image.film.technique_image(sums.unweighted)));
  }
  std::size_t comparisons = 0;
  for (const auto& [technique, values] : means)
    if (technique.light_vertices != 1) ++comparisons;
  for (const auto& [technique, values] : means) {
    if (technique.light_vertices == 1) continue;
    const Technique light_sample{1, technique.edges()};
    const Mean mean = mean_over_renders(values), reference = mean_over_renders(means.at(light_sample));
    CAPTURE(technique.light_vertices, technique.eye_vertices, mean.value, std::sqrt(mean.variance),
            reference.value, std::sqrt(reference.variance));
    REQUIRE(values.size() == renders);
    CHECK(welch_p(mean.value, mean.variance, reference.value, reference.variance, renders) >
          false_alarm_rate / static_cast<double>(comparisons));
  }
}
