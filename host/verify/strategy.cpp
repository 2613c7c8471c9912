#include "verify/strategy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phlux::verify {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double largest_survival = 0.999; // LARGEST_SURVIVAL of kernels/lobes/material.cl

double largest(const Rgb& rgb) {
  return std::max({rgb.r, rgb.g, rgb.b});
}

double smooth_density(const std::string& name, const Direction& w) {
  if (w.z <= 0) return 0;
  if (name == "uniform") return 1 / (2 * pi);
  if (name == "theta-phi") return 1 / (pi * pi * std::hypot(w.x, w.y));
  return cosine_density(w);
}

// Largest weight, f_r cos / density, of a density that does not depend on the lobe.
double smooth_bound(const std::string& name, const Situation& at) {
  const double largest_value =
      largest(at.model.diffuse + at.model.specular * ((at.model.exponent + 2) / 2)) / pi;
  if (name == "uniform") return 2 * pi * largest_value;
  if (name == "theta-phi") return pi * pi / 2 * largest_value; // sin cos <= 1 / 2
  return pi * largest_value;
}

} // namespace

const std::vector<Strategy>& strategies() {
  // Rejection sampling takes about n draws per sample, so that its exponent is limited.
  static const std::vector<Strategy> list{{"uniform", Family::smooth},
                                          {"theta-phi", Family::smooth},
                                          {"cosine", Family::smooth},
                                          {"disk", Family::smooth},
                                          {"rejection", Family::whole, Guess::exact, 100},
                                          {"lobe-ks", Family::parts, Guess::certain},
                                          {"lobe-estimate-printed", Family::parts, Guess::estimated_printed},
                                          {"lobe-estimate", Family::parts, Guess::estimated},
                                          {"lobe-rho", Family::parts},
                                          {"mixture", Family::mixture},
                                          {"fold", Family::fold},
                                          {"exact", Family::whole}};
  return list;
}

double density(const Strategy& strategy, const Situation& at, const Direction& w) {
  const Model& m = at.model;
  if (strategy.family == Family::smooth) return smooth_density(strategy.name, w);
  // The mean of an estimate.
  const double guess = strategy.guess == Guess::certain     ? 1
                       : strategy.guess == Guess::estimated ? 0.5 + 0.5 * at.reflectivity
                                                            : at.reflectivity;
  const double diffuse = m.diffuse_max(), specular = m.specular_max() * guess, total = diffuse + specular;
  if (strategy.family == Family::whole)
    return cosine_density(w) * (diffuse + m.specular_max() * lobe(m.exponent, at.fixed, w)) / total;
  const double lobe = strategy.family == Family::fold ? fold_density(m.exponent, at.fixed, w)
                                                      : lobe_density(m.exponent, at.fixed, w);
  return (diffuse * cosine_density(w) + specular * lobe) / total;
}

bool at_jump(const Strategy& strategy, const Situation& at, const Direction& w) {
  constexpr double reach = 1e-6; // several ulp of a direction's components
  const double cosine = w.z * at.fixed.z - w.x * at.fixed.x - w.y * at.fixed.y;
  return std::abs(cosine) < reach ||
         (strategy.family == Family::fold && std::abs(image_height(at.fixed, w)) < reach);
}

double survival_of(const Situation& at, double guess, bool roulette) {
  return roulette ? std::min(largest(at.model.diffuse + at.model.specular * guess), largest_survival) : 1.0;
}

PartShares shares_of(const Situation& at, double guess, bool roulette) {
  const double diffuse = at.model.diffuse_max(), specular = at.model.specular_max() * guess;
  const double survival = survival_of(at, guess, roulette);
  if (diffuse + specular == 0) return {0, survival};
  return {survival * diffuse / (diffuse + specular), survival * specular / (diffuse + specular)};
}

PartShares mean_shares(const Situation& at, const std::vector<GuessedValue>& guesses, bool roulette) {
  PartShares mean;
  for (const auto& [guess, probability] : guesses) {
    const PartShares shares = shares_of(at, guess, roulette);
    mean.diffuse += probability * shares.diffuse;
    mean.specular += probability * shares.specular;
  }
  return mean;
}

std::optional<double> weight_bound(const Strategy& strategy, const Situation& at, bool roulette) {
  if (strategy.biased()) return std::nullopt; // the estimate, by which the weight is divided, may be nearly 0
  const Model& m = at.model;
  const double by = survival_of(at, at.reflectivity, roulette);
  if (strategy.family == Family::smooth) return smooth_bound(strategy.name, at) / by;
  const double total = m.diffuse_max() + m.specular_max() * at.reflectivity;
  if (strategy.family == Family::whole) return total / by; // 1 for grey materials with roulette
  // The weight of a lobe sample is at most (n + 2) / (n + 1) / guess of the reflectivity.
  const double lobe = (m.exponent + 2) / (m.exponent + 1);
  double bound = 0;
  const std::vector<double> guesses = strategy.guess == Guess::certain ? std::vector<double>{1}
                                      : strategy.guess == Guess::estimated
                                          ? std::vector<double>{0.5, 1}
                                          : std::vector<double>{at.reflectivity};
  for (const double guess : guesses)
    bound = std::max(bound, (m.diffuse_max() + m.specular_max() * guess) / survival_of(at, guess, roulette) *
                                std::max(1.0, lobe / guess));
  return bound;
}

} // namespace phlux::verify
