// Splats are reproducible bit for bit, none is lost, and the film estimates their variance.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "images/evidence.h"
#include "images/integrators.h"
#include "images/prepared_render.h"
#include "images/room.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;

namespace {

const std::vector<Method> both = {light, bidir};

render::Settings with(const Method& method, int samples, std::uint64_t seed = 0) {
  render::Settings result = by(method, settings_for(samples));
  result.seed = seed;
  return result;
}

bool same_bits(const film::Film& a, const film::Film& b) {
  for (std::size_t i = 0; i < a.pixels().size(); ++i)
    if (a.mean(i) != b.mean(i) || a.variance_of_mean(i) != b.variance_of_mean(i)) return false;
  return a.pixels().size() == b.pixels().size();
}

// Closed, and all walls emit: only roulette ends paths.
scene::Scene bright_box(double albedo, int size) {
  scene::Scene scene = shipped("furnace-box", size, size);
  for (scene::Material& material : scene.materials) material = diffuse(Rgb(albedo));
  return scene;
}

} // namespace

TEST_CASE("light and bidir: the same seed gives the same bits, whatever the length of launches") {
  const scene::Scene scene = shipped("cornell-box", 33, 17);
  for (const Method& method : both) {
    CAPTURE(name_of(method));
    // Whole blocks of samples and a partial one.
    render::Settings settings = with(method, 100, 7);
    settings.launch_seconds = 0.001;
    const Render first = render_of(scene, settings);
    CHECK(first.statistics.paths == 33 * 17 * 100);
    CHECK(same_bits(render_of(scene, settings).film, first.film));
    settings.launch_seconds = 0.5;
    CHECK(same_bits(render_of(scene, settings).film, first.film));
    settings.seed = 8;
    CHECK_FALSE(same_bits(render_of(scene, settings).film, first.film));
  }
}

TEST_CASE("a scene that is prepared once is rendered with each seed as it is by itself, bit for bit") {
  const scene::Scene scene = shipped("cornell-box", 33, 17);
  for (const Method& method : both) {
    CAPTURE(name_of(method));
    const PreparedRender prepared(scene, with(method, 100));
    for (const std::uint64_t seed : {7, 8})
      CHECK(same_bits(prepared.image(seed, 100).film, render_of(scene, with(method, 100, seed)).film));
  }
}

TEST_CASE("light and bidir: 1, 4, 8 and 16 lanes render the same image") {
  const scene::Scene scene = shipped("cornell-box", 16, 16);
  for (const Method& method : both) {
    render::Settings settings = with(method, 64);
    settings.lanes = 16;
    const Repeated reference = repeated(scene, method, settings, 8);
    for (const int lanes : {1, 4, 8}) {
      CAPTURE(name_of(method), lanes);
      settings.lanes = lanes;
      settings.seed += 100;
      check_methods(repeated(scene, method, settings, 8), reference, 2);
    }
  }
}

// The space for splats and vertices is estimated before the first launch, and grows after a launch that
// needed more.
TEST_CASE("paths of a hundred edges and their splats all count") {
  constexpr double albedo = 0.98;
  const scene::Scene scene = bright_box(albedo, 6);
  constexpr int edges = 80;
  const double sum = (1 - std::pow(albedo, edges)) / (1 - albedo);
  for (const Method& method : both) {
    CAPTURE(name_of(method));
    render::Settings settings = with(method, method.integrator == "light" ? 512 : 64);
    settings.rr_depth = 50;
    settings.max_depth = edges;
    const Render box = render_of(scene, settings);
    CHECK(box.statistics.paths == 36u * static_cast<unsigned>(settings.samples_per_pixel));
    CHECK(box.statistics.nonfinite == 0);
    check_agreement(estimate_of(box.film), uniform(box.film, {sum, sum, sum}));
    settings.launch_seconds = 0.001;
    CHECK(same_bits(render_of(scene, settings).film, box.film));
  }
}

TEST_CASE("films of light and bidir scatter as their variances say") {
  const scene::Scene scene = room({"rectangle", "constant"});
  constexpr int renders = 24;
  for (const Method& method : both) {
    CAPTURE(name_of(method));
    std::vector<Estimate> images;
    for (int i = 0; i < renders; ++i)
      images.push_back(estimate_of(render_of(scene, with(method, 32, static_cast<std::uint64_t>(i))).film));
    double ratio = 0, pixels = 0;
    for (std::size_t pixel = 0; pixel < images[0].mean.size(); ++pixel) {
      double mean = 0, squares = 0, said = 0;
      for (const Estimate& image : images) {
        mean += image.mean[pixel][1] / renders;
        squares += image.mean[pixel][1] * image.mean[pixel][1] / renders;
        said += image.variance[pixel][1] / renders;
      }
      if (said <= 0) continue;
      ratio += (squares - mean * mean) * renders / (renders - 1.0) / said;
      ++pixels;
    }
    CHECK(pixels > 200);
    // The ratio of a normal pixel has the variance 2 / 23; the mean of 256 has a standard error of 0.02,
    // somewhat more if skewed.
    CHECK(ratio / pixels == Approx(1).margin(0.12));
  }
}
