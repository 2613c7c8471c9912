// Tests of sampling that hold for every reflectance model.
#pragma once

#include <algorithm>
#include <vector>

#include "material_test.h"
#include "quadrature.h"
#include "statistics.h"

namespace device_test {

/// Integrals of the density on the device over the cells of a grid.
inline std::vector<double> density_in_cells(const MaterialProgram& program, int material, const Float3& fixed,
                                            const SphereGrid& grid) {
  const auto nodes = grid.nodes();
  std::vector<Float3> directions;
  for (const Node& node : nodes) directions.push_back(to_float(node.direction));
  const auto density = program.density(material, {fixed}, directions);
  std::vector<double> cells(grid.cells(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) cells[nodes[i].cell] += nodes[i].weight * density[i];
  return cells;
}

/// Tests that the directions of the samples have the density whose integrals are in the cells. The rest of
/// the probability, 1 - sum, is that of samples that did not survive or have no direction (not a unit
/// vector).
inline double directions_p(const std::vector<Sample>& samples, const SphereGrid& grid,
                           std::vector<double> cells) {
  std::vector<double> observed(cells.size() + 1, 0.0);
  double kept = 0, inside = 0;
  for (const Sample& s : samples) {
    if (s.survives == 0) continue;
    const auto direction = to_double(s.direction);
    const bool unit = std::abs(glm::dot(direction, direction) - 1) < 1e-5;
    observed[unit ? grid.cell_of(direction) : cells.size()] += 1;
    kept += 1;
  }
  for (const double cell : cells) inside += cell;
  cells.push_back(std::max(0.0, 1 - inside));
  for (double& cell : cells) cell *= kept;
  return chi_square_p(observed, cells);
}

/// Tests that the mean weight, 0 for samples that do not survive, is `reflectivity`. Returns the least
/// p-value of the three channels, which the caller must count as three questions.
inline double weights_p(const std::vector<Sample>& samples, const glm::dvec3& reflectivity) {
  glm::dvec3 sum(0), squares(0);
  for (const Sample& s : samples) {
    const auto weight = s.survives != 0 ? to_double(s.weight) : glm::dvec3(0);
    sum += weight;
    squares += weight * weight;
  }
  const auto count = static_cast<double>(samples.size());
  double worst = 1;
  for (int channel = 0; channel < 3; ++channel) {
    const double mean = sum[channel] / count;
    const double variance = std::max(0.0, squares[channel] / count - mean * mean);
    worst = std::min(worst, mean_p(mean, std::sqrt(variance / count), reflectivity[channel]));
  }
  return worst;
}

/// Number of invalid samples: weights that are not finite, negative, not 0 below the surface, or without a
/// positive density.
inline std::size_t bad_weights(const std::vector<Sample>& samples) {
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [](const Sample& s) {
    if (s.survives == 0) return false;
    const glm::dvec3 weight = to_double(s.weight);
    const bool fine = weight.x >= 0 && weight.y >= 0 && weight.z >= 0 && glm::dot(weight, weight) < 1e30;
    const bool carries = weight != glm::dvec3(0);
    return !fine || s.draws < 1 || (carries && !(s.density > 0 && s.direction.z > 0));
  }));
}

/// The largest relative difference between the density of a sample and that evaluated for its direction, and,
/// if `whole`, between its weight and eval cos / density; for samples above the surface, without roulette.
inline double disagreement(const MaterialProgram& program, int material, const Float3& fixed,
                           const std::vector<Sample>& samples, bool whole) {
  std::vector<Float3> directions;
  std::vector<Sample> above;
  for (const Sample& s : samples)
    if (s.direction.z > 0) {
      directions.push_back(s.direction);
      above.push_back(s);
    }
  if (above.empty()) return 0;
  const auto density = program.density(material, {fixed}, directions);
  const auto value = program.eval(material, {fixed}, directions);
  double worst = 0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const double stated = above[i].density;
    worst = std::max(worst, std::abs(stated - density[i]) / std::max<double>(density[i], 1e-30));
    if (!whole) continue;
    const auto right = to_double(value[i]) * (above[i].direction.z / stated);
    for (int channel = 0; channel < 3; ++channel) {
      const double weight = to_double(above[i].weight)[channel];
      if (right[channel] > 1e-20) worst = std::max(worst, std::abs(weight - right[channel]) / right[channel]);
    }
  }
  return worst;
}

} // namespace device_test
