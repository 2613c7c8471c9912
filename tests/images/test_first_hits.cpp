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
  const auto at = [&](int x, int y) { return hits[static_cast<std::size_t>(y * 32 + x)]; };

  const film::FirstHit left = at(7, 24);
  CHECK(left.albedo[0] == Approx(0.2).epsilon(1e-5));
  CHECK(left.albedo[2] == Approx(0.6).epsilon(1e-5));
  CHECK(left.normal[2] == Approx(1.0).epsilon(1e-5));
  CHECK(left.depth == Approx(4.0).epsilon(1e-5));

  const film::FirstHit back = at(24, 24); // reflects nothing; its normal is on the side that is seen
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
