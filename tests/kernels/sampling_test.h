// What every way of sampling a reflectance model must do, whichever the model.
#pragma once

#include <algorithm>
#include <vector>

#include "material_test.h"
#include "measure/moments.h"
#include "measure/sphere_grid.h"
#include "questions.h"

namespace device_test {

using phlux::measure::lobe_cuts;
using phlux::measure::SphereGrid;

inline std::vector<glm::dvec3> directions_of(const std::vector<phlux::measure::Node>& nodes) {
  std::vector<glm::dvec3> directions;
  for (const auto& node : nodes) directions.push_back(node.direction);
  return directions;
}

/// The density on the device, integrated over the cells of a grid.
inline std::vector<double> density_in_cells(const DeviceModel& model, int material, const glm::dvec3& fixed,
                                            const SphereGrid& grid) {
  const auto nodes = grid.nodes();
  const auto values = evaluate(model, material, fixed, directions_of(nodes));
  std::vector<double> cells(grid.cells(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) cells[nodes[i].cell] += nodes[i].weight * values[i].density;
  return cells;
}

/// That the samples' directions have the density that is in the cells. Samples that did not survive, and
/// directions that stand for none (not unit vectors), count as what is missing from 1.
inline double directions_p(const std::vector<Sample>& samples, const SphereGrid& grid,
                           std::vector<double> cells) {
  std::vector<double> observed(cells.size() + 1, 0.0);
  double kept = 0, inside = 0;
  for (const Sample& s : samples) {
    if (!s.survives) continue;
    const bool unit = std::abs(glm::dot(s.direction, s.direction) - 1) < 1e-5;
    observed[unit ? grid.cell_of(s.direction) : cells.size()] += 1;
    kept += 1;
  }
  for (const double cell : cells) inside += cell;
  cells.push_back(std::max(0.0, 1 - inside));
  for (double& cell : cells) cell *= kept;
  return chi_square_p(observed, cells);
}

/// That the mean of what samples carry on, where they survive, is `reflectivity`, in the channel where it
/// fits worst; the caller counts three questions.
inline double weights_p(const std::vector<Sample>& samples, const glm::dvec3& reflectivity) {
  double worst = 1;
  for (int channel = 0; channel < 3; ++channel) {
    phlux::measure::PowerSums sums;
    for (const Sample& s : samples) sums.add(s.survives ? s.weight[channel] : 0);
    const auto moments = moments_of(sums);
    worst = std::min(worst, mean_p(moments.mean, moments.mean_standard_error, reflectivity[channel]));
  }
  return worst;
}

/// Samples that are wrong by themselves: weights that are not finite, negative, or not 0 below the surface,
/// or that a density does not go with.
inline std::size_t bad_weights(const std::vector<Sample>& samples) {
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [](const Sample& s) {
    if (!s.survives) return false;
    const glm::dvec3& weight = s.weight;
    const bool fine = weight.x >= 0 && weight.y >= 0 && weight.z >= 0 && glm::dot(weight, weight) < 1e30;
    const bool carries = weight != glm::dvec3(0);
    return !fine || s.draws < 1 || (carries && !(s.density > 0 && s.direction.z > 0));
  }));
}

/// The largest relative difference between a sample's density and that of its direction, and, where `whole`,
/// between its weight and f_r cos / density; samples above the surface and without roulette.
inline double disagreement(const DeviceModel& model, int material, const glm::dvec3& fixed,
                           const std::vector<Sample>& samples, bool whole) {
  std::vector<glm::dvec3> directions;
  std::vector<Sample> above;
  for (const Sample& s : samples)
    if (s.direction.z > 0) {
      directions.push_back(s.direction);
      above.push_back(s);
    }
  if (above.empty()) return 0;
  const auto values = evaluate(model, material, fixed, directions);
  double worst = 0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const double stated = above[i].density, density = values[i].density;
    worst = std::max(worst, std::abs(stated - density) / std::max(density, 1e-30));
    if (!whole) continue;
    const auto right = values[i].value * (above[i].direction.z / stated);
    for (int channel = 0; channel < 3; ++channel) {
      const double weight = above[i].weight[channel];
      if (right[channel] > 1e-20) worst = std::max(worst, std::abs(weight - right[channel]) / right[channel]);
    }
  }
  return worst;
}

} // namespace device_test
