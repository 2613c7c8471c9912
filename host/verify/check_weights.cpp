#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verify/checks.h"

namespace phlux::verify {
namespace {

constexpr double weight_error = 1e-5; // relative to the weight in float64 for the same direction

double relative(double seen, double right) {
  if (right == 0) return seen == 0 ? 0 : INFINITY;
  return std::abs(seen - right) / std::abs(right);
}

double worst_relative(const Rgb& seen, const Rgb& right) {
  // The relative error of n log1p(-x) in float32 is 2^-24, that of its exponential, down to 1e-30, at most
  // -ln(1e-30) / 2^24 = 4e-6. Smaller values are not compared.
  double worst = 0;
  for (int channel = 0; channel < 3; ++channel)
    if (right[channel] > 1e-30 || right[channel] == 0)
      worst = std::max(worst, relative(seen[channel], right[channel]));
  return worst;
}

// The error of the weight of one part. The sampled part is not known, so that the smaller error counts.
double part_error(const Subject& subject, const Drawn& drawn, const Sample& s) {
  const Model& m = drawn.one.at.model;
  const double guess = subject.strategy.guess == Guess::certain ? 1 : drawn.one.at.reflectivity;
  const PartShares shares = shares_of(drawn.one.at, guess, drawn.roulette);
  const Rgb from_diffuse = m.diffuse / shares.diffuse;
  // shares.specular is the probability of the part, which is proportional to ks_max.
  const double lobe = (m.exponent + 2) / (m.exponent + 1) * s.direction.z;
  const Rgb from_lobe = m.specular * (lobe / shares.specular);
  double error = INFINITY;
  if (shares.diffuse > 0) error = worst_relative(s.weight, from_diffuse);
  if (shares.specular > 0) error = std::min(error, worst_relative(s.weight, from_lobe));
  return error;
}

Rgb whole_weight(const Subject& subject, const Drawn& drawn, const Sample& s) {
  const Situation& at = drawn.one.at;
  const double survival = survival_of(at, at.reflectivity, drawn.roulette);
  return value(at.model, at.fixed, s.direction) *
         (s.direction.z / (density(subject.strategy, at, s.direction) * survival));
}

} // namespace

void check_weights(const Subject& subject, const Drawn& drawn) {
  const Strategy& strategy = subject.strategy;
  const Situation& at = drawn.one.at;
  const bool grey =
      at.model.diffuse == Rgb(at.model.diffuse.r) && at.model.specular == Rgb(at.model.specular.r);
  const auto bound = weight_bound(strategy, at, drawn.roulette);
  double worst = 0, edge = 0, largest = 0, from_one = 0;
  for (const Sample& s : drawn.samples) {
    if (!s.survives) continue;
    largest = std::max({largest, s.weight.r, s.weight.g, s.weight.b});
    if (s.direction.z <= 0) {
      if (s.weight != Rgb(0)) worst = INFINITY; // nothing is reflected below the surface
      continue;
    }
    if (strategy.family == Family::parts) {
      if (!strategy.estimates()) worst = std::max(worst, part_error(subject, drawn, s));
    } else if (!at_jump(strategy, at, s.direction)) {
      const double error = worst_relative(s.weight, whole_weight(subject, drawn, s));
      const double condition = lobe_condition(at.model.exponent, at.fixed, s.direction);
      if (condition < well_conditioned)
        worst = std::max(worst, error);
      else
        edge = std::max(edge, error / edge_error(condition));
    }
    if (strategy.name == "exact" && grey && drawn.roulette && at.total().r < 0.999)
      from_one = std::max(from_one, std::abs(s.weight.r - 1));
  }
  if (!strategy.estimates())
    subject.report.record(strategy.name, "weights", worst, weight_error, drawn.where);
  subject.report.record(strategy.name, "edge", edge, 1, drawn.where); // see check_densities
  if (bound) subject.report.record(strategy.name, "bounds", largest / *bound, 1 + weight_error, drawn.where);
  if (strategy.name == "exact" && grey && drawn.roulette)
    subject.report.record(strategy.name, "weight 1", from_one, weight_error, drawn.where);
}

} // namespace phlux::verify
