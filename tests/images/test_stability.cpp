// The scenes of scenes/stability, each of which one method or other cannot render: that it fails, what holds
// instead and how well, and that nothing but noise goes wrong. scenes/stability/README.md has the figures.
#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "film/reliability.h"
#include "images/integrators.h"
#include "phong/reflectivity.h"
#include "scene_file/load.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;
using scene::Rgb;
using scene::Vec3;

namespace {

using Definitions = std::map<std::string, std::string>;

constexpr int width = 32, height = 24, tile = 4;

const std::filesystem::path folder = PHLUX_SOURCE_DIR "/scenes/stability";

scene::Scene stability(const std::string& name, Definitions definitions = {}) {
  definitions.insert({{"width", std::to_string(width)}, {"height", std::to_string(height)}});
  return scene_file::load(folder / (name + ".xml"), definitions);
}

render::Settings with(const Method& method, int samples, std::uint64_t seed) {
  render::Settings result = by(method, settings_for(samples));
  result.seed = seed;
  return result;
}

film::Film film_by(const Method& method, const scene::Scene& scene, int samples, std::uint64_t seed) {
  Render render = render_of(scene, with(method, samples, seed));
  CHECK(render.statistics.nonfinite == 0);
  return std::move(render.film);
}

Estimate image_by(const Method& method, const scene::Scene& scene, int samples, std::uint64_t seed) {
  return estimate_of(film_by(method, scene, samples, seed));
}

// Whether the program would say that the film's error estimate can be believed, with its reasons if not.
void check_verdict(const film::Film& film, bool trusted) {
  const film::Reliability verdict = film::reliability_of(film);
  CAPTURE(verdict.reasons);
  CHECK(verdict.trusted == trusted);
  CHECK(verdict.reasons.empty() == verdict.trusted);
}

// That tiles differ by noise alone. Pixels of one path are not independent, and so nothing is said of the
// image's mean.
void check_tiles(const Estimate& image, const Estimate& reference) {
  const Agreement result = agreement_of_pixels(tiles(image, tile), tiles(reference, tile));
  INFO(result.message);
  CHECK(result.agrees);
}

// Root of the mean squared difference of tiles, relative to the root of their mean square.
double relative_error(const Estimate& image, const Estimate& reference) {
  const Estimate a = tiles(image, tile), b = tiles(reference, tile);
  double difference = 0, square = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      difference += std::pow(a.mean[i][c] - b.mean[i][c], 2);
      square += std::pow(b.mean[i][c], 2);
    }
  return std::sqrt(difference / square);
}

double mean_of(const Estimate& image) {
  double sum = 0;
  for (const Channels& mean : image.mean) sum += mean[0] + mean[1] + mean[2];
  return sum / (3.0 * static_cast<double>(image.mean.size()));
}

// In another unit of radiance.
Estimate scaled(Estimate image, double factor) {
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      image.mean[i][c] *= factor;
      image.variance[i][c] *= factor * factor;
    }
  return image;
}

struct Failure {
  const char* scene;
  std::vector<Method> hold; ///< within `error` of the reference, and agree with it
  std::vector<Method> fail; ///< off by `failure` or more, and said to be unreliable
  int samples;              ///< a pixel, of both
  double error, failure;    ///< of tiles, relative
  Method reference;
  int reference_samples;
  std::vector<Method> doubted =
      {}; ///< of those that hold: errors of tiles are right, of some pixels too small
};

const Failure failures[] = {
    {"tiny-light", {path_light_samples, path, light}, {path_hits}, 256, 0.05, 0.9, bidir, 512},
    {"caustic", {bidir, light}, {path_hits, path_light_samples, path}, 256, 0.05, 0.4, light, 2048},
    {"mirror", {path, bidir}, {light}, 256, 0.05, 0.9, bidir, 1024, {path, bidir}},
    {"narrow-view", {path_light_samples, path, bidir}, {light}, 64, 0.02, 0.2, path, 512},
    {"corner", {path, bidir}, {bidir_uniform}, 64, 0.025, 0.3, bidir, 512},
    {"near-light", {path, bidir}, {path_light_samples}, 64, 0.02, 0.04, bidir, 512},
    {"corridor", {light}, {path_hits}, 64, 0.1, 0.3, light, 512},
    {"mirrored-caustic", {bidir}, {light, path_light_samples}, 512, 0.2, 0.5, bidir, 2048, {bidir}},
    {"keyhole", {light}, {path_hits, path_light_samples, path}, 256, 0.05, 0.2, light, 1024},
};

} // namespace

TEST_CASE("failure scenes: one method is far off where another holds") {
  for (const Failure& failure : failures) DYNAMIC_SECTION(failure.scene) {
      const scene::Scene scene = stability(failure.scene);
      const Estimate reference = image_by(failure.reference, scene, failure.reference_samples, 1000);
      for (const Method& method : failure.hold) {
        INFO(name_of(method));
        const film::Film film = film_by(method, scene, failure.samples, 2000);
        CHECK(relative_error(estimate_of(film), reference) < failure.error);
        check_tiles(estimate_of(film), reference);
        check_verdict(film, std::ranges::find(failure.doubted, method) == failure.doubted.end());
      }
      for (const Method& method : failure.fail) {
        INFO(name_of(method));
        const film::Film film = film_by(method, scene, failure.samples, 3000);
        CHECK(relative_error(estimate_of(film), reference) > failure.failure);
        check_verdict(film, false);
      }
    }
}

TEST_CASE("a corridor of albedo .98 needs its depth: ten edges bring less than a hundredth of the light") {
  const scene::Scene scene = stability("corridor");
  const double whole = mean_of(image_by(light, scene, 256, 1));
  render::Settings cut = with(light, 256, 2), early = with(light, 256, 3);
  cut.max_depth = 10;
  CHECK(mean_of(estimate_of(render_of(scene, cut).film)) < 0.01 * whole);
  early.rr_depth = 1; // roulette may begin at any edge
  CHECK(mean_of(estimate_of(render_of(scene, early).film)) == Approx(whole).epsilon(0.05));
}

TEST_CASE("a corridor whose walls emit what they absorb is as bright everywhere") {
  scene::Scene scene = stability("corridor");
  for (scene::Material& material : scene.materials) material = diffuse(Rgb(0.98));
  scene.area_emitters = {{Rgb(0.02)}};
  scene.patches.pop_back(); // the light
  for (scene::Patch& patch : scene.patches) patch.surface.area_emitter = 0;
  const Render lit = render_of(scene, with(path_hits, 256, 1));
  CHECK(lit.statistics.nonfinite == 0);
  check_agreement(tiles(estimate_of(lit.film), tile), tiles(uniform(lit.film, {1, 1, 1}), tile));
}

TEST_CASE("a glossy floor at grazing angles is as bright as its reflectivity") {
  const scene::Scene scene = stability("grazing");
  const Estimate reference = expected(scene.camera, [](const Vec3& direction) {
    const double radiance = 0.9 * phong::lobe_reflectivity(50, -direction.y);
    return Channels{radiance, radiance, radiance};
  });
  for (const Method& method : {path_hits, bidir}) {
    CAPTURE(name_of(method));
    const film::Film film = film_by(method, scene, 64, 1);
    CHECK(relative_error(estimate_of(film), reference) < 0.01);
    check_verdict(film, true);
  }
  const film::Film by_light = film_by(light, scene, 64, 1);
  CHECK(relative_error(estimate_of(by_light), reference) > 0.3);
  check_verdict(by_light, false);
  render::Settings printed = with(path_hits, 64, 1); // MATH.md 2.4
  printed.strategy = "lobe-estimate-printed";
  CHECK(mean_of(estimate_of(render_of(scene, printed).film)) < 0.8 * mean_of(reference));
}

TEST_CASE("exponents from 0 to a million: path and bidir agree, light fails as the floor becomes a mirror") {
  for (const char* exponent : {"0", "30", "1000", "1000000"}) {
    CAPTURE(exponent);
    const scene::Scene scene = stability("mirror", {{"exponent", exponent}});
    const Estimate reference = image_by(path, scene, 256, 1000);
    check_tiles(image_by(bidir, scene, 256, 2000), reference);
    const film::Film film = film_by(light, scene, 256, 3000);
    const double error = relative_error(estimate_of(film), reference);
    const bool mirror = std::stod(exponent) > 100;
    CHECK((error > 0.5) == mirror);
    CHECK((error < 0.15) != mirror);
    if (mirror) check_verdict(film, false);
  }
}

TEST_CASE("rooms of 1e-4 and 1e4 units, 1e5 from the origin, and lamps of 1e-8 and 1e8 W give one image") {
  const Estimate reference = image_by(path, stability("extremes"), 512, 1000);
  const std::pair<Definitions, double> variants[] = {
      {{{"scale", "1e-4"}, {"inverse", "1e4"}}, 1},
      {{{"scale", "1e4"}, {"inverse", "1e-4"}}, 1},
      {{{"x", "1e5"}, {"y", "-1e5"}, {"z", "1e5"}}, 1},
      {{{"power", "1e-8"}}, 40 / 1e-8},
      {{{"power", "1e8"}}, 40 / 1e8},
  };
  std::uint64_t seed = 2000;
  for (const auto& [definitions, factor] : variants)
    for (const Method& method : {path, light, bidir}) {
      CAPTURE(definitions, name_of(method));
      const Estimate image = image_by(method, stability("extremes", definitions), 128, ++seed);
      check_tiles(scaled(image, factor), reference);
    }
}

TEST_CASE("a lamp of 1e-8 W is not starved by one of 1e8 W next door") {
  const scene::Scene both = stability("dark-and-bright");
  scene::Scene alone = both;
  alone.patches.resize(7);
  const Estimate reference = image_by(bidir, alone, 256, 1000);
  for (const Method& method : {path, light}) {
    CAPTURE(name_of(method));
    const Estimate image = image_by(method, both, 256, 2000);
    CHECK(relative_error(image, reference) < 0.05);
    check_tiles(image, reference);
  }
}

TEST_CASE("floor and light of needle triangles look like rectangles") {
  const scene::Scene needles = stability("slivers");
  scene::Scene rectangles = needles;
  rectangles.meshes.clear();
  rectangles.patches.push_back(square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, needles.meshes[0].surface));
  rectangles.patches.push_back(square({0, 1.9, 0}, {1, 0, 0}, {0, 0, 1}, 0.3, needles.meshes[1].surface));
  const Estimate reference = image_by(path, rectangles, 512, 1000);
  for (const Method& method : {path, bidir}) {
    CAPTURE(name_of(method));
    render::Settings settings = with(method, 128, 2000);
    settings.traversal = render::Traversal::bvh;
    const Render render = render_of(needles, settings);
    CHECK(render.statistics.nonfinite == 0);
    CHECK(relative_error(estimate_of(render.film), reference) < 0.03);
    check_tiles(estimate_of(render.film), reference);
  }
}

// What is below would be seen through a gap between two needles.
TEST_CASE("nothing shines through a floor of needle triangles") {
  scene::Scene scene = stability("slivers");
  scene.patches.push_back(square({0, -0.5, 0}, {0, 0, 1}, {1, 0, 0}, 3, scene.meshes[1].surface));
  scene.camera = look_at({0.1, 0.9, 0.2}, {0.05, 0, 0.1}, 60, width, height);
  render::Settings settings = with(path, 4096, 1);
  settings.traversal = render::Traversal::bvh;
  settings.max_depth = 1;
  CHECK(mean_of(estimate_of(render_of(scene, settings).film)) == 0);
  scene.meshes[0].triangles.pop_back();
  CHECK(mean_of(estimate_of(render_of(scene, settings).film)) > 0);
}

namespace {

// As million_lights.py.
void scatter_lights(scene::Mesh& mesh, int side) {
  constexpr double edge = 0.15;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(0, 1 - edge);
  mesh.positions.clear();
  mesh.triangles.clear();
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const Vec3 corner(column - side / 2 + place(generator), 1, row - side / 2 + place(generator));
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(),
                            {corner, corner + Vec3(edge, 0, 0), corner + Vec3(0, 0, edge)});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
}

} // namespace

TEST_CASE(
    "among a million lights a light sample by power finds the near ones by chance, by contribution at once") {
  const TemporaryFolder mesh;
  mesh.write("one.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                        "end_header\n0 1 0\n1 1 0\n0 1 1\n3 0 1 2\n");
  scene::Scene scene = stability("million-lights", {{"lights", (mesh / "one.ply").string()}});
  scatter_lights(scene.meshes.at(0), 1000);
  const Estimate by_contribution = image_by(path_light_samples, scene, 64, 1);
  render::Settings by_power = with(path_light_samples, 512, 2);
  by_power.light_selection = render::LightSelection::power;
  const film::Film samples = render_of(scene, by_power).film;
  // A sky of as much light; the lights reflect, too, and are where chance put them.
  const double sky = 0.5 * 0.15 * 0.15 * 100;
  const Estimate reference = expected(
      scene.camera,
      [&](const Vec3& direction) {
        const double lobe = 0.1 * phong::lobe_reflectivity(10, -direction.y);
        return Channels{sky * (0.6 + lobe), 0.9 * sky * (0.55 + lobe), 0.7 * sky * (0.5 + lobe)};
      },
      4);
  CHECK(mean_of(by_contribution) == Approx(mean_of(reference)).epsilon(0.1));
  CHECK(relative_error(by_contribution, reference) < 0.25);
  CHECK(relative_error(estimate_of(samples), reference) > 0.4);
  check_verdict(samples, false);
}

namespace {

// Means over runs of pixels of an image that is one pixel wide or high.
Estimate strip(const Estimate& image, int run) {
  const auto pixels = static_cast<double>(run);
  Estimate result = closed_form(static_cast<int>(image.mean.size()) / run, 1, {});
  result.mean.resize(static_cast<std::size_t>(result.width));
  result.variance.resize(result.mean.size());
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      result.mean[i / static_cast<std::size_t>(run)][c] += image.mean[i][c] / pixels;
      result.variance[i / static_cast<std::size_t>(run)][c] += image.variance[i][c] / pixels / pixels;
    }
  return result;
}

} // namespace

TEST_CASE("films of one pixel, one column and one row") {
  const std::tuple<const char*, const char*, int> films[] = {
      {"1", "1", 65536}, {"1", "16384", 16}, {"16384", "1", 16}};
  for (const auto& [width, height, samples] : films) {
    const scene::Scene scene =
        stability("extremes", {{"width", width}, {"height", height}, {"fovAxis", "larger"}});
    const int run = samples > 16 ? 1 : 256;
    const Estimate reference = strip(image_by(path, scene, samples, 1000), run);
    for (const Method& method : {light, bidir}) {
      CAPTURE(width, height, name_of(method));
      const Estimate image = strip(image_by(method, scene, samples, 2000), run);
      if (run > 1 && method.integrator == "light") continue; // hardly a particle meets so narrow a film
      const Agreement result = agreement_of_pixels(image, reference);
      INFO(result.message);
      CHECK(result.agrees);
    }
  }
}

// No surface reflects more than it receives: under a sky of 1 nothing is brighter than 1.
TEST_CASE("no failure scene makes energy") {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem();
    // Those of triangles would be two kernels more to build, and the floor of `grazing` is known exactly.
    if (entry.path().extension() != ".xml" || name == "million-lights" || name == "slivers" ||
        name == "grazing")
      continue;
    CAPTURE(name);
    scene::Scene scene = stability(name);
    scene.area_emitters.clear();
    for (scene::Patch& patch : scene.patches) patch.surface.area_emitter = -1;
    scene.constant_radiance = Rgb(1);
    // Sampled exactly, no path is worth more than the sky, so that no noise excuses a bright pixel.
    const Estimate hits = image_by(path_hits, scene, 16, 1), all = image_by(bidir, scene, 32, 2);
    for (std::size_t i = 0; i < hits.mean.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        if (hits.mean[i][c] > 1 + rounding) FAIL_CHECK("pixel " << i << ": " << hits.mean[i][c]);
    CHECK(mean_of(all) <= 1.02);
  }
}

namespace {

// Part of the 95% intervals of all values that hold the mean of them. Images of other seeds have the same
// expectation.
double coverage(const std::vector<Estimate>& images) {
  int inside = 0, all = 0;
  for (std::size_t pixel = 0; pixel < images[0].mean.size(); ++pixel) {
    double mean = 0;
    for (const Estimate& image : images) mean += image.mean[pixel][1] / static_cast<double>(images.size());
    if (mean <= 0) continue;
    for (const Estimate& image : images) {
      inside += std::abs(image.mean[pixel][1] - mean) <= 1.96 * std::sqrt(image.variance[pixel][1]);
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
  return coverage(images);
}

// Of 400 streams of random numbers: pixels that all see the same point, which is as good as seeds and takes
// one render.
double coverage_of_streams(const char* name, const Method& method, int samples) {
  scene::Scene scene = stability(name, {{"width", "20"}, {"height", "20"}});
  scene.camera.tan_half_fov_x *= 1e-4;
  const Estimate image = image_by(method, scene, samples, 1);
  std::vector<Estimate> pixels;
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    pixels.push_back({1, 1, {image.mean[i]}, {image.variance[i]}});
  return coverage(pixels);
}

void check_coverage(double coverage) {
  CHECK(coverage > 0.93);
  CHECK(coverage < 0.97);
}

} // namespace

// 400 intervals of a coverage of 95% leave these bounds with a chance of 7%, and 24 pixels of 60 seeds with
// one of 1e-3: the seeds are fixed.
TEST_CASE("the 95% interval holds the right value 93% to 97% of the time") {
  check_coverage(coverage_of_streams("narrow-view", path, 512));
  check_coverage(coverage_of_streams("near-light", path, 512));
  check_coverage(coverage_of_streams("tiny-light", bidir, 512));
  check_coverage(coverage_of_seeds("caustic", light, 1024, 60));
}

TEST_CASE("the 95% interval holds the right value for 93% to 97% of 400 seeds", "[.long]") {
  check_coverage(coverage_of_seeds("narrow-view", path, 512, 400));
  check_coverage(coverage_of_seeds("corner", bidir, 512, 400));
  check_coverage(coverage_of_seeds("caustic", light, 1024, 400));
}
