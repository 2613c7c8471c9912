#include "bench/remedies/remedies.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "bench/remedies/many_lights_scene.h"

using namespace phlux;
using namespace phlux::bench;

TEST_CASE("The renders before and after a remedy differ only in that remedy") {
  RemediesOptions options;
  options.lanes = 4;
  options.seed = 7;
  std::set<std::string> met;
  for (RemedyCase& one : remedy_cases(options)) {
    CAPTURE(one.remedy, one.place, one.method.name());
    met.insert(one.remedy);
    const render::Settings &before = one.before, &after = one.after;
    const bool selection = before.light_selection != after.light_selection,
               connections = before.connections != after.connections,
               strategy = before.strategy != after.strategy;
    CHECK(selection == (one.remedy == "light-selection"));
    CHECK(connections == (one.remedy == "connections"));
    CHECK(strategy == (one.remedy == "exact-lobe"));
    CHECK(after.light_selection == render::Settings().light_selection); // after: the defaults
    CHECK(after.connections == render::Settings().connections);
    CHECK(after.strategy == render::Settings().strategy);
    for (const render::Settings& settings : {before, after}) {
      CHECK(settings.seed == 7);
      CHECK(settings.lanes == 4);
      CHECK(settings.integrator == one.method.integrator);
    }
  }
  const auto& names = remedy_names();
  CHECK(met == std::set<std::string>(names.begin(), names.end()));
  options.remedies = {"connections"};
  const auto some = remedy_cases(options);
  CHECK_FALSE(some.empty());
  CHECK(std::ranges::all_of(some, [](const RemedyCase& one) { return one.remedy == "connections"; }));
}

TEST_CASE("The gain is the ratio of variance x time, with the standard errors of both variances") {
  const Efficiency before{{8, 0.4}, 3e-6, 10}, after{{2, 0.2}, 6e-6, 5};
  const Estimate gain = gain_of(before, after);
  CHECK(gain.value == Approx(2));
  CHECK(gain.standard_error == Approx(2 * std::hypot(0.05, 0.1)));
}

TEST_CASE("The scene of many lights has the requested number, reproducibly") {
  const scene::Scene scene = many_lights_scene(64, 8), again = many_lights_scene(64, 8);
  REQUIRE(scene.patches.size() == 65);
  CHECK(scene.area_emitters.size() == 64);
  for (std::size_t i = 1; i < scene.patches.size(); ++i) {
    CHECK(scene.patches[i].origin == again.patches[i].origin);
    CHECK(scene.patches[i].origin.y == 1);
    CHECK(glm::cross(scene.patches[i].edge_u, scene.patches[i].edge_v).y < 0); // they face down
  }
}
