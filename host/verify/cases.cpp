#include "verify/cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "scene/scene.h"

namespace phlux::verify {
namespace {

std::string rgb_text(const Rgb& c) {
  return c.r == c.g && c.g == c.b ? fmt::format("{:.3g}", c.r)
                                  : fmt::format("({:.3g} {:.3g} {:.3g})", c.r, c.g, c.b);
}

} // namespace

Case make_case(const std::vector<scene::Material>& materials, int material, double degrees) {
  Case one;
  one.material = material;
  one.degrees = degrees;
  one.at.model = model_of(materials[static_cast<std::size_t>(material)]);
  const double angle = degrees * std::numbers::pi / 180;
  // At a longitude that distinguishes x from y; along the normal with a cosine that rounding has made larger
  // than 1.
  one.at.fixed = degrees == 0 ? Direction(0, 0, 1 + 0x1p-23) : as_float(polar(angle, 2.2));
  const double tilt = std::atan2(std::hypot(one.at.fixed.x, one.at.fixed.y), one.at.fixed.z);
  one.at.reflectivity = lobe_reflectivity(one.at.model.exponent, tilt);
  one.name = fmt::format("kd {}, ks {}, n {:g}, {:g} degrees", rgb_text(one.at.model.diffuse),
                         rgb_text(one.at.model.specular), one.at.model.exponent, degrees);
  return one;
}

Cases make_cases(bool quick) {
  // The first is the material of CW 197's figures 6 and 7.
  std::vector<scene::Material> materials{lobes::phong(Rgb(.4), Rgb(.05), 50),
                                         lobes::phong({.4, .3, .2}, {.3, .4, .5}, 10),
                                         lobes::phong({.05, .1, 0}, {.8, .6, .9}, 1000),
                                         lobes::phong({0, 0, 0}, {.9, .5, .1}, 1),
                                         lobes::phong(Rgb(.05), Rgb(.9), 1e6),
                                         lobes::phong({.7, .6, .5}, {.25, .2, .3}, 2)};
  std::vector<double> angles{0, 50, 80, 89.9};
  if (!quick) {
    for (const auto& m : {lobes::phong(Rgb(0), Rgb(1), 10), lobes::phong(Rgb(.1), Rgb(.8), 90),
                          lobes::phong(Rgb(.2), Rgb(.3), 0), lobes::phong({.5, .4, .1}, {.1, .4, .2}, 1e4),
                          lobes::phong(Rgb(.7, .5, .3), Rgb(0), 5), lobes::phong(Rgb(.25), Rgb(.5), 2.5)})
      materials.push_back(m);
    angles = {0, 30, 60, 75, 85, 89.9};
  }
  Cases cases{materials, {}};
  for (std::size_t m = 0; m < materials.size(); ++m)
    for (const double angle : angles)
      cases.cases.push_back(make_case(cases.materials, static_cast<int>(m), angle));
  return cases;
}

CaseCells cells_of(const Situation& at) {
  const double n = at.model.exponent;
  CaseCells cells{SphereGrid({-at.fixed.x, -at.fixed.y, at.fixed.z}, lobe_cuts(n)), {}, {}, {}, {}, {}, 0};
  for (auto* part : {&cells.diffuse, &cells.lobe, &cells.fold, &cells.exact})
    part->assign(cells.grid.cells(), 0.0);
  for (const Node& node : cells.grid.nodes()) {
    const double lobe = node.weight * lobe_density(n, at.fixed, node.direction);
    cells.diffuse[node.cell] += node.weight * cosine_density(node.direction);
    cells.lobe[node.cell] += lobe;
    cells.fold[node.cell] += node.weight * fold_density(n, at.fixed, node.direction);
    cells.exact[node.cell] += node.weight * exact_density(n, at.reflectivity, at.fixed, node.direction);
    if (lobe <= 0) continue;
    cells.estimates.push_back({std::clamp((n + 2) / (n + 1) * node.direction.z, 0.0, 1.0), lobe});
    if (node.direction.z <= 0) cells.below += lobe;
  }
  return cells;
}

std::vector<GuessedValue> guesses_of(const Strategy& strategy, const Situation& at, const CaseCells& cells) {
  if (strategy.guess == Guess::certain) return {{1, 1}};
  if (strategy.guess == Guess::exact) return {{at.reflectivity, 1}};
  std::vector<GuessedValue> guesses = cells.estimates;
  if (strategy.guess == Guess::estimated) // averaged with 1, so that it is never 0
    for (GuessedValue& each : guesses) each.guess = (1 + each.guess) / 2;
  return guesses;
}

} // namespace phlux::verify
