#include "random/twin.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "random/methods.h"

namespace phlux::test {
namespace {

// In the order of trial.
constexpr double exponents[] = {50, 20, 10, 5, 2, 1};
constexpr double lamps[] = {0, 0.2, 0.4, 0.8};
constexpr int most_places = 100;

bool in_doubt(const std::vector<render::Settings>& methods, const scene::Scene& scene,
              const SceneFacts& facts) {
  return std::ranges::any_of(methods, [&](const render::Settings& method) {
    return !doubts(for_scene(method, scene, facts), facts).empty();
  });
}

// The largest of `exponents` for which the lobes alone cause no doubts.
double blunt_enough(const std::vector<render::Settings>& methods, const scene::Scene& scene,
                    const SceneFacts& facts) {
  SceneFacts lobes;
  lobes.lights_without_area = facts.lights_without_area;
  for (const double exponent : exponents) {
    lobes.largest_exponent = exponent;
    if (!in_doubt(methods, scene, lobes)) return exponent;
  }
  throw std::runtime_error("no exponent is blunt enough for some method");
}

} // namespace

std::optional<Twin> twin_of(const SceneNumber& number, const std::vector<render::Settings>& methods) {
  const scene::Scene scene = load_random_scene(number);
  const SceneFacts facts = facts_of(scene);
  if (!in_doubt(methods, scene, facts)) return {};
  Twin twin;
  twin.most_exponent = blunt_enough(methods, scene, facts);
  for (; twin.places < most_places; ++twin.places)
    for (const double lamp : lamps) {
      twin.least_lamp = lamp;
      const scene::Scene candidate = load_random_scene(number, twin);
      if (!in_doubt(methods, candidate, facts_of(candidate))) return twin;
    }
  throw std::runtime_error("scene " + name_of(number) + ": no twin is without doubts");
}

} // namespace phlux::test
