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

/// Exponents from 0 to 1e6, grey and coloured, from the normal to 89.9 degrees; fewer of each if `quick`.
[[nodiscard]] Cases make_cases(bool quick);

/// A case of one of the materials; the fixed direction is rounded to float32 and not in a plane of two axes.
[[nodiscard]] Case make_case(const std::vector<scene::Material>& materials, int material, double degrees);

/// Probabilities of the parts of all strategies in the cells of a grid about the lobe, integrated in float64.
struct CaseCells {
  SphereGrid grid;
  std::vector<double> diffuse, lobe, fold, exact; ///< probabilities; `lobe` also below the horizon
  std::vector<GuessedValue> estimates;            ///< of CW 197's one-sample estimate, clamped to [0, 1]
  double below = 0;                               ///< the lobe's probability below the horizon
};
[[nodiscard]] CaseCells cells_of(const Situation& at);

/// The distribution of a strategy's guess of the lobe's reflectivity.
[[nodiscard]] std::vector<GuessedValue> guesses_of(const Strategy& strategy, const Situation& at,
                                                   const CaseCells& cells);

} // namespace phlux::verify
