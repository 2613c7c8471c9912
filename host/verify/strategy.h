// Reference of the strategies of phong.cl in float64: their densities, probabilities of lobes, and bounds of
// weights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/model.h"

namespace phlux::verify {

enum class Family {
  smooth,  ///< a density that does not depend on the lobe
  parts,   ///< chooses a lobe; weight of that lobe
  mixture, ///< chooses a lobe; weight f_r cos / density of both lobes
  fold,    ///< as mixture, with the part of the lobe below the horizon folded up
  whole    ///< f_r cos itself, normalised
};
enum class Guess {
  certain,
  exact,
  estimated,
  estimated_printed
}; ///< of the lobe's reflectivity, for the choice

struct Strategy {
  std::string name;
  Family family = Family::smooth;
  Guess guess = Guess::exact;
  double largest_exponent = 1e6; ///< larger ones take too many draws or samples to be checked

  [[nodiscard]] bool biased() const { return guess == Guess::estimated_printed; }
  [[nodiscard]] bool estimates() const {
    return guess == Guess::estimated || guess == Guess::estimated_printed;
  }
};

/// All strategies of render::strategy_names(), in the same order.
[[nodiscard]] const std::vector<Strategy>& strategies();

/// A material, a fixed direction, and the lobe's reflectivity for it, by quadrature.
struct Situation {
  Model model;
  Direction fixed;
  double reflectivity = 1; ///< rho_s / ks

  [[nodiscard]] Rgb total() const { return model.diffuse + model.specular * reflectivity; }
};

/// The strategy's density of `generated`.
[[nodiscard]] double density(const Strategy& strategy, const Situation& at, const Direction& generated);

/// Whether `generated` is so near a discontinuity of the density that rounding to float32 may cross it: the
/// mirror image of the horizon for `fold`, and alpha = pi / 2 for n = 0.
[[nodiscard]] bool at_jump(const Strategy& strategy, const Situation& at, const Direction& generated);

/// A value of a random guess and its probability.
struct GuessedValue {
  double guess, probability;
};

/// Probabilities that a path survives and samples the diffuse or the specular part.
struct PartShares {
  double diffuse = 0, specular = 0;
};

/// The shares for one guess of the lobe's reflectivity.
[[nodiscard]] PartShares shares_of(const Situation& at, double guess, bool roulette);
/// The mean shares over the strategy's guesses.
[[nodiscard]] PartShares mean_shares(const Situation& at, const std::vector<GuessedValue>& guesses,
                                     bool roulette);

/// The probability of surviving roulette for one guess.
[[nodiscard]] double survival_of(const Situation& at, double guess, bool roulette);

/// Upper bound of the weights of all channels; nothing if they are unbounded.
[[nodiscard]] std::optional<double> weight_bound(const Strategy& strategy, const Situation& at,
                                                 bool roulette);

} // namespace phlux::verify
