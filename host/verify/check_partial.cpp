#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "measure/statistics.h"
#include "verify/checks.h"
#include "verify/disk_grid.h"

namespace phlux::verify {
namespace {

constexpr int side = 21;
constexpr double evaluated_error = 1e-5; // of the device's f_r, summed over a cell, relative to the whole
constexpr double sum_error = 1e-4;       // of the reflectivity function

// Partial reflectivities of the cells by integration, evaluation and sampling. The last cell, of samples
// only, is the rest of the hemisphere.
struct Partial {
  std::vector<Rgb> integrated, evaluated, sampled;
  std::vector<Rgb> squares; // expected square of a sample's weight, 0 outside the cell
};

// The mean square of a weight per solid angle, without roulette: (f_r cos)^2 / density, or the sum of that of
// each part.
Rgb square_density(const Strategy& strategy, const Situation& at, const Direction& w) {
  if (strategy.family != Family::parts) {
    const Rgb carried = value(at.model, at.fixed, w) * w.z;
    const double by = density(strategy, at, w);
    return by > 0 ? carried * carried / by : Rgb(0);
  }
  const PartShares shares = shares_of(at, strategy.guess == Guess::certain ? 1 : at.reflectivity, false);
  const double n = at.model.exponent, lobe = (n + 2) / (n + 1) * w.z;
  Rgb sum(0);
  if (shares.diffuse > 0) sum += at.model.diffuse * at.model.diffuse / shares.diffuse * cosine_density(w);
  if (shares.specular > 0)
    sum += at.model.specular * at.model.specular / shares.specular *
           (lobe * lobe * lobe_density(n, at.fixed, w));
  return sum;
}

Partial integrate(const Subject& subject, const Case& one, const DiskGrid& grid) {
  const std::vector<Rgb> none(grid.cells() + 1, Rgb(0));
  Partial partial{none, none, none, none};
  const auto nodes = grid.nodes(one.at.model.exponent, one.at.fixed);
  std::vector<Pair> pairs;
  for (const Node& node : nodes) pairs.push_back({one.at.fixed, as_float(node.direction)});
  const auto values = subject.device.evaluate(one.material, pairs);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Direction& there = pairs[i].b; // rounded to float32, which matters for n = 1e6
    const double weight = nodes[i].weight, projected = weight * nodes[i].direction.z;
    partial.integrated[nodes[i].cell] += projected * value(one.at.model, one.at.fixed, there);
    partial.evaluated[nodes[i].cell] += projected * values[i].value;
    partial.squares[nodes[i].cell] += weight * square_density(subject.strategy, one.at, there);
  }
  return partial;
}

void add_samples(Partial& partial, const DiskGrid& grid, const std::vector<Sample>& samples) {
  for (const Sample& s : samples)
    partial.sampled[s.direction.z > 0 ? grid.cell_of(s.direction) : grid.cells()] += s.weight;
  for (Rgb& sum : partial.sampled) sum /= static_cast<double>(samples.size());
}

// Chi-square of the sampled against the integrated partial reflectivities. Cells are pooled until their sum
// has enough effective samples to be normal.
double sampled_p(const Partial& partial, std::size_t count, int channel) {
  constexpr double fewest = 100;
  const auto samples = static_cast<double>(count);
  double statistic = 0, off = 0, squares = 0, mean = 0;
  double whole = 0;
  for (const Rgb& cell : partial.integrated) whole += cell[channel];
  const double least = 1e-9 * whole; // smaller sums, whose squares may underflow, are not compared
  int degrees = 0;
  for (std::size_t cell = 0; cell + 1 < partial.integrated.size(); ++cell) {
    off += partial.sampled[cell][channel] - partial.integrated[cell][channel];
    mean += partial.integrated[cell][channel];
    squares += partial.squares[cell][channel];
    if (mean <= least || samples * mean * mean / squares < fewest) continue;
    const double float_error = 1e-5 * mean; // for a cell with all samples, of equal weights
    statistic += off * off / (std::max(0.0, squares - mean * mean) / samples + float_error * float_error);
    ++degrees;
    off = squares = mean = 0;
  }
  return degrees > 0 ? chi_square_tail(statistic, degrees) : 1;
}

Histogram histogram_of(const DiskGrid& grid, const Partial& partial, int channel) {
  Histogram histogram{
      {"x", "y", "sampled", "evaluated", "integrated"},
      {},
      grid.side(),
      {2, 3, 4},
      fmt::format("reflectivity through a square of a direction's (x, y), channel {}", channel)};
  for (std::size_t cell = 0; cell < grid.cells(); ++cell)
    histogram.rows.push_back({grid.x(cell), grid.y(cell), partial.sampled[cell][channel],
                              partial.evaluated[cell][channel], partial.integrated[cell][channel]});
  return histogram;
}

void compare(const Subject& subject, const Case& one, const DiskGrid& grid,
             const std::vector<Sample>& samples, const std::string& where) {
  Partial partial = integrate(subject, one, grid);
  add_samples(partial, grid, samples);
  Report& report = subject.report;
  const std::string& name = subject.strategy.name;
  Rgb sum(0);
  double evaluated = 0;
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    sum += partial.integrated[cell];
    for (int channel = 0; channel < 3; ++channel)
      if (one.at.total()[channel] > 0)
        evaluated = std::max(evaluated,
                             std::abs(partial.evaluated[cell][channel] - partial.integrated[cell][channel]) /
                                 one.at.total()[channel]);
  }
  report.record(name, "evaluated", evaluated, evaluated_error, where);
  if (grid.x(0) < -0.9 && grid.y(0) < -0.9) { // the whole hemisphere
    const Rgb whole = subject.device.reflectivity(one.material, std::vector<double>{one.at.fixed.z}).front();
    for (int channel = 0; channel < 3; ++channel)
      if (whole[channel] > 0)
        report.record(name, "sum", std::abs(sum[channel] / whole[channel] - 1), sum_error, where);
  }
  const Strategy& strategy = subject.strategy;
  if (strategy.estimates() || (strategy.family == Family::smooth && one.at.model.exponent > 100)) return;
  for (int channel = 0; channel < 3; ++channel)
    if (report.record_p(name, "partial", sampled_p(partial, samples.size(), channel), where))
      report.keep(name, "partial", histogram_of(grid, partial, channel));
}

} // namespace

void check_partial(const Subject& subject) {
  std::uint32_t seed = 5000;
  for (const Case& one : subject.cases.cases) {
    ++seed;
    if (one.at.model.exponent > subject.strategy.largest_exponent) continue;
    const std::uint32_t every = subject.samples < thin_samples ? 17 : subject.quick ? 3 : 5;
    if (seed % every != 0) continue;
    const auto samples = subject.device.sample(one.material, one.at.fixed, 2 * subject.samples, seed, false);
    compare(subject, one, DiskGrid(0, 0, 1, side), samples, one.name + ", whole hemisphere");
    const double reach = 4 / std::sqrt(one.at.model.exponent + 1);
    if (reach < 0.5) // most of a narrow lobe is in one of the cells above
      compare(subject, one, DiskGrid(-one.at.fixed.x, -one.at.fixed.y, reach, side), samples,
              one.name + ", around the lobe");
  }
}

} // namespace phlux::verify
