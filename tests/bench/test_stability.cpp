#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include <catch2/catch.hpp>

#include "bench/common/methods/scene_bench.h"
#include "bench/stability/stability.h"
#include "bench/stability/stability_scene.h"
#include "materials.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

const Method none{"path", "exact", "none"}, mis{"path", "exact", "mis"}, bidir{"bidir", "exact", "balance"};

std::vector<MethodResult> measured(const scene::Scene& scene, const std::vector<Method>& methods,
                                   double seconds) {
  SceneBenchSettings settings;
  settings.seconds = seconds;
  SceneBench bench(scene, settings);
  bench.try_methods(methods);
  MethodRenderer renderer(scene, render_settings(bidir, scene, settings));
  ReferenceImage reference = make_reference(renderer, bidir, scene.camera, settings.seed, 0.25, {});
  return bench.measure(reference);
}

double power(const scene::Scene& scene) {
  const scene::Patch& disk = scene.patches.back();
  REQUIRE(disk.surface.area_emitter == 0);
  const double area = std::numbers::pi * glm::length(glm::cross(disk.edge_u, disk.edge_v));
  return std::numbers::pi * area * scene.area_emitters[0].radiance.x;
}

// Whether a point is in the view frustum of the camera.
bool in_view(const scene::Camera& camera, const scene::Vec3& point) {
  const scene::Vec3 d = point - camera.position;
  const double depth = glm::dot(d, camera.forward), reach = depth * camera.tan_half_fov_x;
  return depth > 0 && std::abs(glm::dot(d, camera.left)) < reach && std::abs(glm::dot(d, camera.up)) < reach;
}

} // namespace

TEST_CASE("The light has the same power in every cell and is never visible") {
  for (const StabilityCell& cell : stability_cells(false)) {
    const scene::Scene scene = stability_scene(cell.exponent, cell.light_radius, 8);
    CHECK(power(scene) == Approx(20));
    CHECK(phlux::test::exponent_of(scene.materials[3]) == cell.exponent);
    const scene::Patch& disk = scene.patches.back();
    for (int i = 0; i < 64; ++i) {
      const double angle = 2 * std::numbers::pi * i / 64;
      CHECK_FALSE(
          in_view(scene.camera, disk.origin + std::cos(angle) * disk.edge_u + std::sin(angle) * disk.edge_v));
    }
  }
}

TEST_CASE("The quick cells are a subset of the default cells") {
  const auto all = stability_cells(false), quick = stability_cells(true);
  CHECK(all.size() == 36);
  CHECK(quick.size() == 9);
  for (const StabilityCell& cell : quick) CHECK(std::ranges::count(all, cell) == 1);
}

// A path hits a light of this size about once in 10^9 samples.
TEST_CASE("A method that never hits the light is suspect and does not render the reference") {
  const scene::Scene scene = stability_scene(100, 1e-4, 8);
  SceneBenchSettings settings;
  settings.seconds = 0.5;
  SceneBench bench(scene, settings);
  bench.try_methods({none, mis});
  CHECK(bench.trials()[0].variance == 0);
  ReferenceImage reference = bench.reference();
  CHECK(reference.method == mis.name());
  const auto results = bench.measure(reference);
  CHECK(results[0].verdict == Verdict::suspect_variance);
  CHECK_THAT(results[0].reason, Catch::Contains("never drawn"));
}

// Directions hit a light of this size once in 10^7 samples; about a hundred hits would be needed.
TEST_CASE("With a tiny light, hitting it by chance is suspect and next-event estimation is sound") {
  const Method light_samples{"path", "exact", "light"};
  const auto results = measured(stability_scene(1, .001, 8), {none, light_samples}, 1);
  CHECK(results[0].verdict == Verdict::suspect_variance);
  CHECK_FALSE(results[1].verdict == Verdict::suspect_variance);
  CHECK_FALSE(results[1].verdict == Verdict::biased);
}

// `exact` has the least variance of all strategies if lights are only hit by directions.
TEST_CASE("A method with a worse strategy has more variance in a cell") {
  const Method plain{"path", "uniform", "none"};
  const auto results = measured(stability_scene(10, .3, 8), {none, plain}, 2);
  const Estimate a = results[0].variance, b = results[1].variance;
  CAPTURE(a.value, a.standard_error, b.value, b.standard_error);
  CHECK(b.value - a.value > 4 * std::hypot(a.standard_error, b.standard_error));
}
