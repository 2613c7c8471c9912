#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

#include "verify/checks.h"

namespace phlux::verify {
namespace {

constexpr double density_error = 1e-5;
constexpr std::size_t pairs_per_case = 24; // few, as each takes a quadrature

// The situation with the directions exchanged, as in bidirectional weights.
Situation reversed(const Situation& at, const Direction& fixed) {
  return {at.model, fixed,
          lobe_reflectivity(at.model.exponent, std::atan2(std::hypot(fixed.x, fixed.y), fixed.z))};
}

std::vector<Pair> pairs_of(const Case& one) {
  std::mt19937 engine(static_cast<unsigned>(one.material * 100 + 1));
  const auto uniform = [&] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  const Direction axis(-one.at.fixed.x, -one.at.fixed.y, one.at.fixed.z);
  std::vector<Pair> pairs;
  for (int tries = 0; pairs.size() < pairs_per_case && tries < 1000; ++tries) {
    const Direction any = polar(std::acos(uniform()), 2 * std::numbers::pi * uniform());
    const double width = 3 * uniform() / std::sqrt(one.at.model.exponent + 1);
    const Direction b =
        pairs.size() % 2 == 0 ? any : glm::normalize(axis + width * (any - Direction(0, 0, 0.4)));
    if (b.z > 1e-5) pairs.push_back({one.at.fixed, as_float(b)});
  }
  return pairs;
}

bool compares(const Strategy& strategy, const Situation& at, const Direction& generated) {
  return lobe_condition(at.model.exponent, at.fixed, generated) < well_conditioned &&
         !at_jump(strategy, at, generated);
}

double error_of(double seen, double right) {
  constexpr double smallest = 1e-30;
  return right > smallest ? std::abs(seen - right) / right : (seen > 2 * smallest ? INFINITY : 0);
}

} // namespace

void check_pairs(const Subject& subject) {
  for (const Case& one : subject.cases.cases) {
    const auto pairs = pairs_of(one);
    if (pairs.empty()) continue;
    const auto seen = subject.device.evaluate(one.material, pairs);
    double worst = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      // Each density is returned twice: as the density of one call and as the reverse density of the other.
      const auto compare = [&](const Situation& at, const Direction& generated, double forward,
                               double reverse) {
        if (!compares(subject.strategy, at, generated)) return;
        const double right = density(subject.strategy, at, generated);
        worst = std::max({worst, error_of(forward, right), error_of(reverse, right)});
      };
      compare(one.at, pairs[i].b, seen[i].density, seen[i].reversed_reverse);
      compare(reversed(one.at, pairs[i].b), pairs[i].a, seen[i].reversed_density, seen[i].reverse);
    }
    subject.report.record(subject.strategy.name, "both roles", worst, density_error, one.name);
  }
}

} // namespace phlux::verify
