// Albedo, normal and depth of what the camera sees, against closed forms.
#include <cmath>

#include <catch2/catch.hpp>

#include "images/scenes.h"
#include "phong/reflectivity.h"
#include "render/first_hits.h"

using namespace phlux;
using namespace phlux::test;

namespace {

// Seen along -z from the origin: below on the left a diffuse square at depth 4, on the right the back of one
// at depth 2, above both a phong, and nothing in between. Pixel (x, y) sees ((x + .5) / 16 - 1, 1 - (y + .5)
// / 16) depth.
scene::Scene three_squares() {
  scene::Scene scene;
  scene.camera = look_at({0, 0, 0}, {0, 0, -1}, 90, 32, 32);
  scene.materials = {diffuse({0.2, 0.4, 0.6}), lobes::phong(scene::Rgb(0.3), scene::Rgb(0.5), 20)};
  scene.patches = {square({-2.25, -2, -4}, {1, 0, 0}, {0, 1, 0}, 1.5, {0, -1}),
                   square({1, -1, -2}, {-1, 0, 0}, {0, 1, 0}, 0.5, {0, -1}),
                   square({0, 2, -4}, {1, 0, 0}, {0, 1, 0}, 1.5, {1, -1})};
  scene.constant_radiance = scene::Rgb(1.0);
  return scene;
}

} // namespace

TEST_CASE("First hits are those of closed form, whatever the integrator, and at WIDTH 1") {
  render::Settings settings = settings_for(1);
  const auto& [integrator, lanes] = GENERATE(std::pair{"bidir", 0}, std::pair{"path", 1});
  settings.integrator = integrator;
  settings.lanes = lanes;
  scene::Scene scene = three_squares();
  if (lanes == 1) scene.patches[0].origin.y += 0.125; // half a pixel at depth 4
  const std::vector<film::FirstHit> hits = render::first_hits(scene, settings);
  REQUIRE(hits.size() == 32 * 32);
  const auto at = [&](int x, int y) { return hits[static_cast<std::size_t>(y * 32 + x)].mean; };

  const film::FirstHitValues left = at(7, 24);
  CHECK(left.albedo[0] == Approx(0.2).epsilon(1e-5));
  CHECK(left.albedo[2] == Approx(0.6).epsilon(1e-5));
  CHECK(left.normal[2] == Approx(1.0).epsilon(1e-5));
  CHECK(left.depth == Approx(4.0).epsilon(1e-5));

  const film::FirstHitValues back = at(24, 24); // reflects nothing; its normal is on the side that is seen
  CHECK(back.albedo[1] == 0);
  CHECK(back.normal[2] == Approx(1.0).epsilon(1e-5));
  CHECK(back.depth == Approx(2.0).epsilon(1e-5));

  const double x = 0.5 / 16, y = 7.5 / 16, cosine = 1 / std::sqrt(1 + x * x + y * y);
  CHECK(at(16, 8).albedo[0] == Approx(0.3 + 0.5 * phlux::phong::lobe_reflectivity(20, cosine)).epsilon(2e-3));

  CHECK(at(0, 0).normal[2] == 0);
  CHECK(at(0, 0).depth == 0);
  if (lanes ==
      1) { // the edge is in the middle of the pixel: of 16 samples, 1 to 15 with probability 1 - 3e-5
    CHECK(at(7, 17).normal[2] == Approx(0.5).margin(0.45));
    CHECK(at(7, 17).albedo[0] == Approx(0.2 * static_cast<double>(at(7, 17).normal[2])).epsilon(1e-5));
    CHECK(at(7, 17).depth == Approx(4.0).epsilon(1e-5));
  } else {
    CHECK(at(7, 17).normal[2] == 0);
  }
}

TEST_CASE("Variances of first hits have closed forms at an edge, and are 0 inside a square") {
  scene::Scene scene = three_squares();
  scene.patches[0].origin.y += 0.125; // its edge divides the pixels of row 17 into halves
  double albedo = 0.0, normal = 0.0;
  constexpr int seeds = 10, columns = 8;
  render::Settings settings = settings_for(1);
  for (settings.seed = 0; settings.seed < seeds; ++settings.seed) {
    const std::vector<film::FirstHit> hits = render::first_hits(scene, settings);
    for (std::size_t x = 4; x < 4 + columns; ++x) {
      const film::FirstHitValues& edge = hits[17 * 32 + x].variance;
      albedo += static_cast<double>(edge.albedo[0]) / (seeds * columns);
      normal += static_cast<double>(edge.normal[2]) / (seeds * columns);
      CHECK(edge.depth < 1e-12F);
    }
    for (const std::size_t pixel : {24 * 32 + 7, 0}) { // on the left square, and beside all
      const film::FirstHitValues& none = hits[pixel].variance;
      CHECK(none.albedo == std::array{0.0F, 0.0F, 0.0F});
      CHECK(none.normal == std::array{0.0F, 0.0F, 0.0F});
      CHECK(none.depth < 1e-12F);
    }
  }
  // Of 16 samples each hits with probability 1/2, so that the variance of their mean is 1/64. The relative
  // standard deviation of an estimate is sqrt(2/15) / 4; five of the mean of 80: a false alarm in 2e6.
  const double tolerance = 5 * std::sqrt(2.0 / 15) / 4 / std::sqrt(seeds * columns);
  CHECK(normal == Approx(1.0 / 64).epsilon(tolerance));
  CHECK(albedo == Approx(0.2 * 0.2 / 64).epsilon(tolerance));
}

TEST_CASE("Variances of first hits are those of renders with different seeds") {
  scene::Scene scene = three_squares();
  scene.patches.clear();
  scene.spheres = {{.center = {0, 0, -3}, .radius = 1.5, .surface = {1, -1}}};
  constexpr std::size_t seeds = 32, values = 3; // albedo.R, normal.X, depth.Z
  std::vector<std::vector<film::FirstHit>> renders;
  render::Settings settings = settings_for(1);
  for (settings.seed = 0; settings.seed < seeds; ++settings.seed)
    renders.push_back(render::first_hits(scene, settings));
  const auto value = [](const film::FirstHitValues& of, std::size_t i) {
    return static_cast<double>(std::array{of.albedo[0], of.normal[0], of.depth}[i]);
  };
  for (std::size_t i = 0; i < values; ++i) {
    // Per pixel: the variance of the means over the seeds, less the mean of its estimates.
    double count = 0.0, sum = 0.0, squares = 0.0, stated = 0.0;
    for (int pixel = 0; pixel < 32 * 32; ++pixel) {
      if (std::hypot(pixel % 32 - 15.5, pixel / 32 - 15.5) > 7)
        continue; // the sphere covers those within 8.5
      double mean = 0.0, square = 0.0, variance = 0.0;
      for (const auto& render : renders) {
        const film::FirstHit& hit = render[static_cast<std::size_t>(pixel)];
        mean += value(hit.mean, i) / seeds;
        square += value(hit.mean, i) * value(hit.mean, i) / seeds;
        variance += value(hit.variance, i) / seeds;
      }
      const double difference = (square - mean * mean) * seeds / (seeds - 1) - variance;
      count += 1;
      sum += difference;
      squares += difference * difference;
      stated += variance;
    }
    CAPTURE(i, stated / count, sum / count);
    CHECK(stated > 0);
    CHECK(sum * sum < 25 * squares);        // five standard errors: a false alarm in 2e6
    CHECK(squares * 100 < stated * stated); // and one is below a tenth of the variance
  }
}

TEST_CASE("First hits need no light that rays can hit, nor any light") {
  scene::Scene scene = three_squares();
  const std::vector<film::FirstHit> under_sky = render::first_hits(scene, settings_for(1));
  scene.constant_radiance.reset();
  for (const bool has_light : {false, true}) {
    CAPTURE(has_light);
    if (has_light) scene.point_lights = {{{0, 0, 1}, scene::Rgb(1.0)}};
    const std::vector<film::FirstHit> hits = render::first_hits(scene, settings_for(1));
    REQUIRE(hits.size() == under_sky.size());
    for (std::size_t i = 0; i < hits.size(); ++i) REQUIRE(hits[i].mean.depth == under_sky[i].mean.depth);
  }
}
