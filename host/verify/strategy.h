// What each strategy of phong.cl should do, in float64: the density that it states, how often it takes which
// lobe, and what its weights can be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/model.h"

namespace phlux::verify {

enum class Family {
  smooth,  ///< one density that knows nothing of the lobe
  parts,   ///< one lobe or the other by roulette, weighted alone
  mixture, ///< the same, weighted by f_r cos over the density of both
  fold,    ///< as mixture, the lobe folded up at the horizon
  whole    ///< f_r cos itself, normalised
};
enum class Guess {
  certain,
  exact,
  estimated,
  estimated_printed
}; ///< of the lobe's reflectivity, to choose by

struct Strategy {
  std::string name;
  Family family = Family::smooth;
  Guess guess = Guess::exact;
  double largest_exponent = 1e6; ///< beyond it draws or samples take too long to be checked

  [[nodiscard]] bool biased() const { return guess == Guess::estimated_printed; }
  [[nodiscard]] bool estimates() const {
    return guess == Guess::estimated || guess == Guess::estimated_printed;
  }
};

/// All of render::strategy_names(), in its order.
[[nodiscard]] const std::vector<Strategy>& strategies();

/// A material, a fixed direction, and the lobe's reflectivity there by quadrature.
struct Situation {
  Model model;
  Direction fixed;
  double reflectivity = 1; ///< rho_s / ks

  [[nodiscard]] Rgb total() const { return model.diffuse + model.specular * reflectivity; }
};

/// The density that the strategy states for `generated`.
[[nodiscard]] double density(const Strategy& strategy, const Situation& at, const Direction& generated);

/// Whether a density jumps so near to `generated` that float32 may see it on the other side: at the horizon's
/// image of `fold`, and for n = 0 at alpha = pi / 2.
[[nodiscard]] bool at_jump(const Strategy& strategy, const Situation& at, const Direction& generated);

/// A value of the guess and its probability.
struct GuessedValue {
  double guess, probability;
};

/// The probability that a path survives, and takes either part.
struct PartShares {
  double diffuse = 0, specular = 0;
};

/// The shares for one guess of the lobe's reflectivity.
[[nodiscard]] PartShares shares_of(const Situation& at, double guess, bool roulette);
/// Averaged over what the strategy guesses.
[[nodiscard]] PartShares mean_shares(const Situation& at, const std::vector<GuessedValue>& guesses,
                                     bool roulette);

/// The probability of surviving roulette for one guess.
[[nodiscard]] double survival_of(const Situation& at, double guess, bool roulette);

/// No weight of any channel is larger, in theory; nothing where there is no bound.
[[nodiscard]] std::optional<double> weight_bound(const Strategy& strategy, const Situation& at,
                                                 bool roulette);

} // namespace phlux::verify
