// The materials and angles that are verified.
#pragma once

#include <string>
#include <vector>

#include "lobes/program.h"
#include "measure/sphere_grid.h"
#include "verify/strategy.h"

namespace phlux::verify {

struct Case {
  int material = 0; ///< index in Cases::table
  double degrees = 0;
  Situation at;
  std::string name; ///< such as "kd .4, ks .05, n 50, 30 degrees"
};

struct Cases {
  std::vector<scene::Material> materials;
  std::vector<Case> cases;
};

/// Exponents from 0 to 1e6, grey and coloured, from the normal to 89.9 degrees; fewer of each where `quick`.
[[nodiscard]] Cases make_cases(bool quick);

/// One case of a table's material; the fixed direction is that of float32, off the axes.
[[nodiscard]] Case make_case(const std::vector<scene::Material>& materials, int material, double degrees);

/// What the parts of all strategies have in the cells of a grid about the lobe, integrated in float64.
struct CaseCells {
  SphereGrid grid;
  std::vector<double> diffuse, lobe, fold, exact; ///< probabilities; `lobe` also below the horizon
  std::vector<GuessedValue> estimates;            ///< of CW 197's one-sample estimate, clamped to [0, 1]
  double below = 0;                               ///< of the lobe's probability, that below the horizon
};
[[nodiscard]] CaseCells cells_of(const Situation& at);

/// The guesses of a strategy for the reflectivity of the lobe.
[[nodiscard]] std::vector<GuessedValue> guesses_of(const Strategy& strategy, const Situation& at,
                                                   const CaseCells& cells);

} // namespace phlux::verify
