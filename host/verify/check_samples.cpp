#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "measure/moments.h"
#include "measure/statistics.h"
#include "verify/checks.h"

namespace phlux::verify {
namespace {

// False for invalid directions, such as NaN, which are in no cell.
bool is_unit(const Direction& d) {
  return std::abs(glm::dot(d, d) - 1) < 1e-5;
}

const SphereGrid& plain_grid() { // for densities that do not depend on the lobe
  static const SphereGrid grid({0, 0, 1}, {0.1, 0.3, 0.75, 1.3, 1.5});
  return grid;
}

// Probabilities in closed form; the cells are bounded by angles from the normal and longitudes.
std::vector<double> plain_cells(const std::string& strategy) {
  std::vector<double> cells(plain_grid().cells());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto b = plain_grid().bounds(i);
    if (!b.above || b.angle_to > 1.5708) continue;
    const double share = 1.0 / SphereGrid::longitudes;
    const auto below = [&](double angle) {
      if (strategy == "uniform") return 1 - std::cos(angle);
      if (strategy == "theta-phi") return angle / std::acos(0.0);
      return std::sin(angle) * std::sin(angle);
    };
    cells[i] = share * (below(b.angle_to) - below(b.angle_from));
  }
  return cells;
}

struct Expected {
  const SphereGrid* grid;
  std::vector<double> cells; // probabilities of surviving with a direction in the cell
};

Expected expected_of(const Strategy& strategy, const Drawn& drawn) {
  const Situation& at = drawn.one.at;
  if (strategy.family == Family::smooth) {
    Expected expected{&plain_grid(), plain_cells(strategy.name)};
    for (double& cell : expected.cells) cell *= survival_of(at, at.reflectivity, drawn.roulette);
    return expected;
  }
  const PartShares shares = mean_shares(at, guesses_of(strategy, at, drawn.cells), drawn.roulette);
  const auto& specular = strategy.family == Family::whole  ? drawn.cells.exact
                         : strategy.family == Family::fold ? drawn.cells.fold
                                                           : drawn.cells.lobe;
  Expected expected{&drawn.cells.grid, drawn.cells.diffuse};
  for (std::size_t i = 0; i < specular.size(); ++i)
    expected.cells[i] = shares.diffuse * expected.cells[i] + shares.specular * specular[i];
  return expected;
}

Histogram histogram_of(const SphereGrid& grid, const std::vector<double>& observed,
                       const std::vector<double>& expected) {
  Histogram histogram{
      {"angle_from", "angle_to", "longitude_from", "longitude_to", "above", "observed", "expected"},
      {},
      0,
      {}};
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const auto b = grid.bounds(i);
    histogram.rows.push_back({b.angle_from, b.angle_to, b.longitude_from, b.longitude_to, b.above ? 1. : 0.,
                              observed[i], expected[i]});
  }
  return histogram;
}

} // namespace

void check_directions(const Subject& subject, const Drawn& drawn) {
  Expected expected = expected_of(subject.strategy, drawn);
  const std::size_t cells = expected.cells.size();
  std::vector<double> observed(cells + 1, 0.0); // the last one: absorbed, or no direction
  double inside = 0;
  for (const Sample& s : drawn.samples)
    observed[s.survives && is_unit(s.direction) ? expected.grid->cell_of(s.direction) : cells] += 1;
  for (const double cell : expected.cells) inside += cell;
  expected.cells.push_back(std::max(0.0, 1 - inside));
  for (double& cell : expected.cells) cell *= static_cast<double>(drawn.samples.size());
  const double p = chi_square_p(observed, expected.cells);
  if (subject.report.record_p(subject.strategy.name, "directions", p, drawn.where))
    subject.report.keep(subject.strategy.name, "directions",
                        histogram_of(*expected.grid, observed, expected.cells));
}

void check_means(const Subject& subject, const Drawn& drawn, double& pooled, int& pools) {
  const Strategy& strategy = subject.strategy;
  const Situation& at = drawn.one.at;
  if (strategy.family == Family::smooth && at.model.exponent > 100) return; // too few samples hit the lobe
  if (subject.samples < thin_samples) return; // too few samples of the rarer lobe for a normal mean
  const double kept = strategy.biased() ? 1 - drawn.cells.below : 1; // of the specular part
  const Rgb expected = at.model.diffuse + at.model.specular * (at.reflectivity * kept);
  for (int channel = 0; channel < 3; ++channel) {
    PowerSums sums;
    for (const Sample& s : drawn.samples) sums.add(s.survives ? s.weight[channel] : 0.0);
    const Moments moments = moments_of(sums);
    // The relative error of float32 weights with a reflectivity from a table.
    constexpr double float_error = 1e-5;
    const double off = moments.mean - expected[channel];
    const double allowed = float_error * expected[channel];
    const double error = moments.mean_standard_error;
    const double beyond = std::max(0.0, std::abs(off) - allowed);
    const double sigmas = beyond == 0 ? 0 : beyond / error; // infinite if all weights are equal and wrong
    subject.report.record_p(strategy.name, "means", normal_p(sigmas),
                            fmt::format("{}, channel {}", drawn.where, channel));
    if (channel == 0 && error > allowed) {
      pooled += off / error;
      ++pools;
    }
  }
}

// Errors of the rare second draw of `exact` show only with more samples, and without a diffuse part.
std::size_t samples_of(const Subject& subject, const Case& one) {
  constexpr std::size_t of_redraws = 1 << 18;
  const bool redraws = subject.strategy.name == "exact" && one.at.model.diffuse_max() == 0;
  return redraws && subject.samples >= thin_samples ? std::max(subject.samples, of_redraws) : subject.samples;
}

void check_samples(const Subject& subject) {
  std::uint32_t seed = 1;
  double pooled = 0;
  int pools = 0;
  for (std::size_t i = 0; i < subject.cases.cases.size(); ++i) {
    const Case& one = subject.cases.cases[i];
    seed += 2;
    if (one.at.model.exponent > subject.strategy.largest_exponent) continue;
    for (const bool roulette : {false, true}) {
      const auto samples = subject.device.sample(one.material, one.at.fixed, samples_of(subject, one),
                                                 seed + (roulette ? 1 : 0), roulette);
      const Drawn drawn{one, subject.cells[i], roulette, samples, one.name + (roulette ? ", roulette" : "")};
      check_directions(subject, drawn);
      check_means(subject, drawn, pooled, pools);
      check_weights(subject, drawn);
      check_densities(subject, drawn);
    }
  }
  if (pools > 0)
    subject.report.record(subject.strategy.name, "pooled means", std::abs(pooled) / std::sqrt(pools), 4,
                          fmt::format("{} cases together", pools));
}

} // namespace phlux::verify
