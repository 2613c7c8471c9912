// Recommendations for renders whose error estimate cannot be trusted.
#include <catch2/catch.hpp>

#include "advice/advice.h"
#include "advice/light_shares.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;

TEST_CASE("if path tracing cannot be trusted, trials find a method that can") {
  render::Settings with = settings_for(16);
  const auto bidir = Catch::Contains("try `integrator` bidir"),
             light = Catch::Contains("try `integrator` light");
  advice::Advice advice;
  // On a busy machine the same number of samples takes longer.
  for (double seconds = 0.5; seconds <= 8 && !(bidir || light).match(advice.words); seconds *= 2)
    advice = advice::advise(shipped("caustic", 32, 24), with, seconds);
  REQUIRE(advice.trials.size() == 3); // path is its own method
  CHECK_FALSE(advice.trials[0].reliability.trusted);
  CHECK_THAT(advice.words, bidir || light);
}

TEST_CASE("the light that causes the variance is named") {
  scene::Scene scene = shipped("caustic", 32, 24);
  const scene::PointLight lamp{{0, 1, 1}, scene::Rgb(1)};
  scene.point_lights = {lamp, lamp};
  const scene::Scene before = scene;
  render::Settings with = settings_for(64);
  REQUIRE(advice::light_share_renders(scene) == 3);
  std::vector<advice::LightShare> shares = advice::light_shares(scene, with);
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].light == "area light 1");
  CHECK(shares[0].share > 0.95); // the caustic
  CHECK(shares[2].light == "point light 2");
  CHECK(shares[1].share == Approx(shares[2].share)); // of the same seed
  CHECK(shares[0].share + shares[1].share + shares[2].share == Approx(1.0));
  CHECK(scene.area_emitters[0].radiance == before.area_emitters[0].radiance);
  CHECK(scene.point_lights[1].intensity == before.point_lights[1].intensity);
  scene.point_lights.assign(advice::most_lights, lamp); // one too many
  CHECK(advice::light_shares(scene, with).empty());
}
