#include <cmath>

#include <catch2/catch.hpp>

#include "bench/common/methods/scene_bench.h"
#include "bench/common/methods/timed_render.h"
#include "errors.h"
#include "scene_file/load.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

scene::Scene shipped(const std::string& name, int side) {
  return scene_file::load(PHLUX_SOURCE_DIR "/scenes/" + name + ".xml",
                          {{"width", std::to_string(side)}, {"height", std::to_string(side)}});
}

ImageEstimate pixel_of(const ImageEstimate& image, std::size_t pixel) {
  const auto first = image.radiance.begin() + static_cast<std::ptrdiff_t>(3 * pixel);
  return {{first, first + 3}, {image.samples[pixel]}};
}

// The reference of a furnace, whose radiance is known.
ReferenceImage furnace_reference(const scene::Scene& scene, double radiance) {
  ReferenceImage reference;
  const auto pixels = static_cast<std::size_t>(scene.camera.width * scene.camera.height);
  reference.image = exact_reference(std::vector<double>(3 * pixels, radiance));
  reference.mean = {radiance, 0};
  reference.samples_per_pixel = 1e9;
  return reference;
}

const Method none{"path", "exact", "none"}, mis{"path", "exact", "mis"};

} // namespace

TEST_CASE("Light tracing is known to be biased where mirrors or glass are in view") {
  const Method light{"light", "exact", "-"};
  const auto bias_in = [](const scene::Scene& scene, const Method& method) {
    return KnownBias(scene, render::Settings()).of(method);
  };
  CHECK(!bias_in(shipped("mirror-ball", 16), light).empty());
  CHECK(bias_in(shipped("mirror-ball", 16), mis).empty());
  CHECK(bias_in(shipped("cornell-box", 16), light).empty());
  CHECK(bias_in(shipped("stability/mirrored-caustic", 16), light).empty()); // its mirror is out of view
  scene::Scene masked = shipped("mirror-ball", 16);                         // only other surfaces are seen
  for (scene::Material& material : masked.materials)
    if (material.model->has_delta) material.opacity = scene::Rgb(0.0);
  CHECK(bias_in(masked, light).empty());
  scene::Scene with_point = shipped("mirror-ball", 16);
  with_point.point_lights.push_back({});
  CHECK(!bias_in(with_point, mis).empty());
}

// 200 seeds in groups of ten. Pixels are independent, so each pixel of a group is one experiment. The number
// of intervals that cover the radiance is binomial; the test fails with probability 1e-3 for random seeds.
TEST_CASE("The standard error of the mean covers the radiance of a furnace at the stated rate") {
  const scene::Scene furnace = shipped("furnace-box", 6);
  const render::Settings settings = settings_of(none, furnace.defaults);
  constexpr std::size_t groups = 20, seeds = 10, pixels = 36;
  constexpr double t_95 = 2.2622; // Student's, two-sided, 9 degrees of freedom
  int covered = 0;
  MethodRenderer renderer(furnace, settings);
  for (std::uint64_t group = 0; group < groups; ++group) {
    std::vector<ImageEstimate> images;
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
      images.push_back(estimate_of(renderer.render_samples(group * seeds + seed, 64, {}).film));
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      std::vector<ImageEstimate> of_pixel;
      for (const ImageEstimate& image : images) of_pixel.push_back(pixel_of(image, pixel));
      const Estimate mean = mean_of(image_means(of_pixel));
      covered += std::abs(mean.value - 2.0) < t_95 * mean.standard_error ? 1 : 0;
    }
  }
  constexpr double experiments = groups * pixels;
  CAPTURE(covered);
  CHECK(std::abs(covered - 0.95 * experiments) < 3.29 * std::sqrt(experiments * 0.95 * 0.05));
}

TEST_CASE("The variance between renders agrees with the variance estimated by the films") {
  const scene::Scene scene = shipped("cornell-box", 12);
  const render::Settings settings = settings_of(mis, scene.defaults);
  constexpr int samples = 256;
  std::vector<ImageEstimate> images;
  std::vector<double> within(3 * images.size());
  const Reference ones = exact_reference(std::vector<double>(3 * 144, 1.0));
  double of_films = 0;
  MethodRenderer renderer(scene, settings);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const film::Film film = renderer.render_samples(seed, samples, {}).film;
    images.push_back(estimate_of(film));
    for (std::size_t pixel = 0; pixel < 144; ++pixel)
      for (const double variance : film.variance_of_mean(pixel))
        of_films += variance * samples / 1.0001 / static_cast<double>(ones.radiance.size()) / 10;
  }
  const Estimate between = mean_of(variances_per_sample(images, ones));
  CAPTURE(between.value, between.standard_error, of_films);
  CHECK(p_value(between, of_films) > 1e-3);
}

TEST_CASE("Methods that alternate are ranked correctly, and biased and refused ones are detected") {
  const scene::Scene furnace = shipped("furnace-sphere", 16);
  SceneBenchSettings settings;
  settings.seconds = 16; // 4 s would be enough on an idle machine
  SceneBench bench(furnace, settings);
  const Method plain{"path", "uniform", "none"}, printed{"path", "lobe-estimate-printed", "none"},
      impossible{"none such", "exact", "-"};
  bench.try_methods({none, plain, printed, impossible});
  ReferenceImage reference = bench.reference();
  CHECK(reference.method == none.name());
  const auto results = bench.measure(reference);
  REQUIRE(results.size() == 4);
  CHECK(results[0].verdict == Verdict::sound);
  CHECK(results[0].rounds.size() == 10);
  // `exact` has the least variance of all.
  CHECK(results[1].variance.value - 4 * results[1].variance.standard_error > 2 * results[0].variance.value);
  CHECK(results[2].verdict == Verdict::biased);
  CHECK(results[2].mean_bias_sigma < -4); // the loss of light is also measured
  CHECK(results[3].verdict == Verdict::refused);
  CHECK_THAT(results[3].reason, Catch::Contains("none such"));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& points = results[i].convergence;
    REQUIRE(points.size() >= 3);
    CHECK(points.back().seconds > 3 * points.front().seconds);
    CHECK(points.back().relmse < points.front().relmse);
    CHECK(points.back().relmse_least <= points.back().relmse);
    CHECK(points.back().relmse <= points.back().relmse_most);
  }
}

TEST_CASE("A mean that differs from that of the reference is a bias, and the error converges to it") {
  const scene::Scene furnace = shipped("furnace-box", 8);
  SceneBenchSettings settings;
  settings.seconds = 2;
  SceneBench bench(furnace, settings);
  bench.try_methods({none, mis});
  ReferenceImage exact = furnace_reference(furnace, 2.0), shifted = furnace_reference(furnace, 2.2);
  const auto right = bench.measure(exact);
  CHECK(right[0].verdict == Verdict::sound);
  CHECK(right[1].verdict == Verdict::sound);
  CHECK(std::abs(right[0].mean.value - 2) < 5 * right[0].mean.standard_error);
  const auto wrong = bench.measure(shifted);
  for (const MethodResult& result : wrong) {
    CHECK(result.verdict == Verdict::biased);
    CHECK_THAT(result.reason, Catch::Contains("differs from that of the reference"));
    CHECK(result.convergence.back().relmse == Approx(0.04 / (2.2 * 2.2)).epsilon(0.05));
  }
}

TEST_CASE("A scene that no method can render has no reference") {
  const scene::Scene scene = shipped("point-light", 8);
  SceneBenchSettings settings;
  settings.seconds = 1;
  SceneBench bench(scene, settings);
  bench.try_methods({none});
  CHECK_FALSE(bench.trials().front().refusal.empty());
  CHECK_THROWS_AS((void)bench.reference(), SceneError);
}

TEST_CASE("A render for a given time keeps intermediate images") {
  const scene::Scene scene = shipped("cornell-box", 16);
  const render::Settings settings = settings_of(mis, scene.defaults);
  MethodRenderer renderer(scene, settings);
  TimedRender render;
  // On a busy machine there may be no launch that ends between the two times: then repeats the render.
  for (int attempt = 0; attempt < 20 && render.intermediate.size() < 2; ++attempt)
    render = renderer.render_for(1, 0.2, {0.05, 0.1}, {});
  REQUIRE(render.intermediate.size() == 2);
  CHECK(render.intermediate[0].seconds >= 0.05);
  CHECK(render.intermediate[1].image.samples[0] > render.intermediate[0].image.samples[0]);
  CHECK(render.last.seconds >= 0.2);
  CHECK(render.samples_per_pixel() >= render.intermediate[1].image.samples[0]);
  CHECK(render.seconds_per_sample > 0);
  CHECK(render.seconds_per_sample < render.last.seconds / render.paths * 1.5);
  CHECK(render.processor_seconds_per_sample > 0);
  REQUIRE(render.one_sample);
  // The renderer depends on the seed alone, not on what it rendered before.
  const ImageEstimate again = *renderer.render_one_sample(1).one_sample;
  CHECK(render.one_sample->radiance == again.radiance);
  CHECK(renderer.render_one_sample(2).one_sample->radiance != again.radiance);
  CHECK(again.radiance ==
        estimate_of(MethodRenderer(scene, settings).render_samples(1, 1, {}).film).radiance);
  // A time that is too short for one sample per pixel still gives an image.
  MethodRenderer large(shipped("cornell-box", 256), settings);
  CHECK(large.render_for(1, 1e-6, {}, {}).samples_per_pixel() >= 1);
  CHECK_THROWS_AS(renderer.render_for(1, 10, {}, [] { return true; }), Interrupted);
}

TEST_CASE("Every integrator and variant with every strategy is a method") {
  const auto methods = all_methods({"exact", "fold"}, false);
  CHECK(methods.size() == 14);
  CHECK(methods[2].name() == "path mis");
  CHECK(methods[9].name() == "path mis, fold");
  CHECK(methods[3].name() == "light");
  CHECK(all_methods({"exact"}, true).size() == 5);
  CHECK(settings_of(methods[1], {}).connect == render::Connect::light);
  CHECK(settings_of(methods[9], {}).strategy == "fold");
  CHECK(settings_of(methods[3], {}).integrator == "light");
  CHECK(settings_of(methods[5], {}).weights == render::Weights::power);
}
