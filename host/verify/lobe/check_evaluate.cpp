#include <numbers>
#include <random>

#include <glm/geometric.hpp>

#include "verify/lobe/checks.h"

namespace phlux::verify {
namespace {

bool is_valid(const PairValues& v) {
  const auto density = [](double d) { return std::isfinite(d) && d >= 0; };
  const auto value = [](const Rgb& f) { return is_finite(f) && std::min({f.r, f.g, f.b}) >= 0; };
  return value(v.value) && value(v.reversed) && density(v.density) && density(v.reversed_density) &&
         density(v.reverse) && density(v.reversed_reverse);
}

double disagreement_of_values(const Rgb& a, const Rgb& b, double floor) {
  double worst = 0;
  for (int channel = 0; channel < 3; ++channel)
    worst = std::max(worst, disagreement(a[channel], b[channel], floor));
  return worst;
}

// What rounding of directions may change: at the edge of a lobe, where cosines to a facet approach 0, that is
// a small part of the lobe's height and a large one of the value itself.
double floor_of(const std::vector<PairValues>& values) {
  double highest = 0;
  for (const PairValues& v : values)
    if (is_valid(v)) highest = std::max({highest, v.density, v.reverse, v.value.r, v.value.g, v.value.b});
  return std::max(density_floor, 1e-6 * highest);
}

// Records values that are not finite and replaces them by 0 for the integrals.
std::vector<PairValues> evaluate(const LobeSubject& subject, const LobeCase& one,
                                 const std::vector<Pair>& pairs) {
  std::vector<PairValues> values = subject.device.evaluate(one.material, pairs);
  double wrong = 0, asymmetry = 0, reverse = 0;
  const double floor = floor_of(values);
  for (PairValues& v : values) {
    if (!is_valid(v)) {
      ++wrong;
      v = PairValues();
    }
    asymmetry = std::max(asymmetry, disagreement_of_values(v.value, v.reversed, floor));
    reverse = std::max({reverse, disagreement(v.reverse, v.reversed_density, floor),
                        disagreement(v.reversed_reverse, v.density, floor)});
  }
  subject.record("evaluate finite", wrong, 0, one.where);
  subject.record("reciprocity", asymmetry, agreement, one.where);
  subject.record("reverse", reverse, agreement, one.where);
  return values;
}

constexpr int levels_about_lobes = 5; // cells of 2 degrees

} // namespace

DirectionTree integrate_lobe(const LobeSubject& subject, const LobeCase& one) {
  DirectionTree tree(subject.model.transmits);
  const Direction& d = one.fixed;
  for (const Direction& likely : {Direction(0, 0, 1), d, Direction(-d.x, -d.y, d.z), -d})
    tree.split_about(likely, levels_about_lobes);
  std::vector<Direction> pilots;
  for (const Sample& s : subject.device.sample(one.material, d, subject.samples / 4, one.seed + 1, false))
    if (!s.delta && is_finite(s.direction) && subject.counts(s)) pilots.push_back(s.direction);
  tree.split_by(pilots);
  tree.integrate([&](const std::vector<Direction>& directions) {
    std::vector<Pair> pairs;
    for (const Direction& b : directions) pairs.push_back({d, as_float(b)});
    std::vector<Integrals> integrands;
    for (const PairValues& v : evaluate(subject, one, pairs))
      integrands.push_back({v.density, v.value * std::abs(pairs[integrands.size()].b.z)});
    return integrands;
  });
  return tree;
}

void check_below(const LobeSubject& subject, const LobeCase& one) {
  constexpr int count = 64;
  std::mt19937 engine(7);
  const auto uniform = [&] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const Direction a = polar(std::acos(uniform()), 2 * std::numbers::pi * uniform()),
                    b = polar(std::acos(-uniform()), 2 * std::numbers::pi * uniform());
    pairs.push_back({as_float(a), as_float(b)});
  }
  double wrong = 0;
  for (const PairValues& v : subject.device.evaluate(one.material, pairs))
    if (!std::isfinite(v.density) || !std::isfinite(v.reverse)) ++wrong;
  subject.record("evaluate finite", wrong, 0, one.where + ", generated below the surface");
}

void check_isotropy(const LobeSubject& subject, const LobeCase& one) {
  if (subject.model.needs_tangents) return;
  constexpr std::size_t count = 64;
  constexpr double turn = 1.1;
  std::mt19937 engine(5);
  const auto uniform = [&] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const double theta_a = std::acos(uniform()), theta_b = std::acos(uniform());
    const double phi_a = 2 * std::numbers::pi * uniform(), phi_b = phi_a + (uniform() - 0.5);
    for (const double turned : {0.0, turn})
      pairs.push_back({as_float(polar(theta_a, phi_a + turned)), as_float(polar(theta_b, phi_b + turned))});
  }
  const auto values = evaluate(subject, one, pairs);
  double worst = 0;
  for (std::size_t i = 0; i < values.size(); i += 2)
    worst = std::max({worst, disagreement_of_values(values[i].value, values[i + 1].value, density_floor),
                      disagreement(values[i].density, values[i + 1].density, density_floor)});
  subject.record("isotropy", worst, agreement, one.where);
}

} // namespace phlux::verify
