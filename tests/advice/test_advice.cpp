// Comparison of integrators in short trial renders.
#include <catch2/catch.hpp>

#include "advice/advice.h"
#include "advice/automatic.h"
#include "advice/light_shares.h"
#include "errors.h"
#include "images/scenes.h"

using namespace phlux;
using namespace phlux::test;

TEST_CASE("where path tracing lacks most of the light, the advice is a method that does not") {
  const auto bidir = Catch::StartsWith("try `integrator` bidir: at least "),
             light = Catch::StartsWith("try `integrator` light: at least ");
  advice::Advice advice;
  double seconds = 0.25; // on a busy machine the same number of samples takes longer
  for (; seconds <= 8 && !advice.found; seconds *= 2)
    advice = advice::advise(shipped("caustic", 32, 24), settings_for(16), seconds);
  REQUIRE(advice.trials.size() == 3); // path is its own method
  CHECK_FALSE(advice.trials[0].reliability.trusted);
  CHECK_THAT(advice.words, bidir || light);
  // The standard error of samples that are not negative is never above their mean; the right one is.
  CHECK(advice.trials[0].cost > 1.2 * seconds / 2);
}

TEST_CASE("the advice says so if no method is better, or if too few samples tell") {
  const auto words = [](const char* scene, double seconds) {
    return advice::advise(shipped(scene, 64, 64), settings_for(16), seconds).words;
  };
  CHECK(words("cornell-box", 0.3) == "no better integrator was found in trials of 0.3 s");
  CHECK(words("caustic", 1e-4) == "trials of 0.0001 s are too noisy to tell which integrator is better");
}

TEST_CASE("no better integrator is found only where the error of the own one is known well enough") {
  const auto words = [](double cost, bool trusted) { // relative to the only other method
    advice::Trial own, other;
    own.method = "path", own.cost = cost;
    own.reliability.trusted = trusted, own.reliability.coverage = 0.8;
    other.method = "bidir", other.cost = 1;
    other.reliability.trusted = true, other.reliability.coverage = 0.94;
    advice::Advice advice;
    advice.trials = {own, other};
    advice::conclude(advice, 1);
    return advice.words;
  };
  CHECK(words(3, true) == "try bidir: about 3 times as efficient in a trial of 1 s");
  CHECK(words(1.2, true) == "no better integrator was found in trials of 1 s");
  CHECK(words(0.5, false) == "no better integrator was found in trials of 1 s");
  CHECK(words(1.2, false) == "trials of 1 s are too noisy to tell which integrator is better");
}

TEST_CASE("where path finds a caustic by chance only, the advice says so and names what finds it") {
  const auto words = [](const char* scene) {
    return advice::advise(shipped(scene, 16, 16), settings_for(1), 0.01).words;
  };
  const auto caustics = Catch::Contains("by chance only: bidir finds them");
  CHECK_THAT(words("glass-caustic"), caustics);
  CHECK_THAT(words("cornell-box"), !caustics);
}

TEST_CASE("where light tracing shows mirrors black, the advice is bidir, and never light") {
  render::Settings with = settings_for(1);
  with.integrator = "light";
  const advice::Advice of_light = advice::advise(shipped("mirror-ball", 16, 16), with, 0.05);
  CHECK(of_light.found);
  CHECK(of_light.words ==
        "try `integrator` bidir: light misses what the camera sees in mirrors and through smooth glass");
  const advice::Advice of_path = advice::advise(shipped("mirror-and-glass", 16, 16), settings_for(1), 0.05);
  CHECK(of_path.trials.size() == 2); // path, bidir
}

TEST_CASE("light that a trial lacks is seen by the means of others") {
  const auto trial = [](double radiance, double variance) {
    advice::Trial result;
    result.tiles = {{radiance, variance, 64}, {100, 1, 64}};
    return result;
  };
  const advice::Trial lacking = trial(60, 9), other = trial(80, 16), noisy = trial(60, 25);
  const auto missing = [](const advice::Trial& one, const advice::Trial& two) {
    const advice::Trial others[] = {one, two};
    return advice::missing_error(one, others);
  };
  // 20 of 80 in one of two tiles of 64 pixels, as root mean square of a pixel; 20 is 4.0 and 3.1 errors.
  CHECK(missing(lacking, trial(80.1, 16)) == Approx(std::sqrt(64 / 2.0) * 20.1 / 80.1));
  CHECK(missing(other, lacking) == 0);
  CHECK(missing(noisy, other) == 0);
  CHECK(missing(lacking, advice::Trial()) == 0); // refused
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

namespace {

advice::MethodChoice choice_for(scene::Scene scene, int samples,
                                std::map<std::string, std::string> texts = {}) {
  settings::Choices choices;
  choices.texts = std::move(texts);
  choices.texts["integrator"] = "auto";
  choices.texts["spp"] = std::to_string(samples);
  return advice::choose_method(std::move(scene), choices, settings_for(1));
}

} // namespace

TEST_CASE("integrator auto: the method with the least error, the same each time") {
  const advice::MethodChoice caustic = choice_for(shipped("caustic", 64, 48), 20'000);
  CHECK(caustic.texts.at("integrator") != "path");
  CHECK_THAT(caustic.words, Catch::StartsWith("`integrator` " + caustic.texts.at("integrator")));
  CHECK(choice_for(shipped("caustic", 64, 48), 20'000).words == caustic.words);
  CHECK(choice_for(shipped("glass-caustic", 256, 256), 400).texts.at("integrator") == "bidir");
  const advice::MethodChoice near_light = choice_for(shipped("stability/near-light", 64, 48), 20'000);
  CHECK(near_light.texts.at("integrator") == "path");
  CHECK(near_light.texts.at("sampler") == "lattice");
  CHECK_THAT(near_light.words, Catch::StartsWith("`integrator` path `sampler` lattice: "));
  CHECK(!choice_for(shipped("stability/near-light", 64, 48), 20'000, {{"sampler", "independent"}})
             .texts.contains("sampler"));
  CHECK(choice_for(shipped("stability/near-light", 512, 512), 128).texts.at("sampler") == "lattice");
  CHECK(!choice_for(shipped("stability/near-light", 512, 512), 127).texts.contains("sampler"));
  CHECK(!choice_for(shipped("stability/near-light", 512, 512), 64).texts.contains("sampler")); // few samples
  // With independent samples light needs 0.9 of the time of bidir.
  CHECK(choice_for(shipped("point-light", 128, 128), 2000).texts.at("integrator") == "bidir");
  const advice::MethodChoice furnace = choice_for(shipped("furnace-box", 64, 48), 20'000); // light all around
  CHECK(furnace.texts.at("connect") == "none");
}

TEST_CASE(
    "integrator auto: no trials for short renders, none of integrators that are excluded or miss light") {
  CHECK(choice_for(shipped("caustic", 64, 48), 16).words ==
        "`integrator` path: the render is too short for trials");
  CHECK(choice_for(shipped("caustic", 64, 48), 16, {{"weights", "power"}}).words ==
        "`integrator` bidir `weights` power: no other method can render this scene with these options");
  CHECK(choice_for(shipped("glass-caustic", 64, 48), 16).words == // the scene's integrator
        "`integrator` bidir: the render is too short for trials");
  CHECK_THROWS_AS(choice_for(shipped("caustic", 64, 48), 16, {{"weights", "power"}, {"connect", "light"}}),
                  UsageError);
  scene::Scene mirror = shipped("mirror-ball", 32, 32);
  mirror.point_lights.push_back({{0, 1, 0}, scene::Rgb(1)});
  CHECK(choice_for(std::move(mirror), 16).texts.at("integrator") == "bidir");
}
