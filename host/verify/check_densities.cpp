#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verify/checks.h"

namespace phlux::verify {
namespace {

constexpr double density_error = 1e-5; // relative to the density in float64 for the same direction
constexpr double unit_error = 4 * 0x1p-23;
constexpr double smallest_density = 1e-30; // smaller ones may underflow float32

} // namespace

void check_densities(const Subject& subject, const Drawn& drawn) {
  const Strategy& strategy = subject.strategy;
  const Situation& at = drawn.one.at;
  double worst = 0, edge = 0, length = 0, wrong = 0;
  for (const Sample& s : drawn.samples) {
    if (!s.survives) continue;
    if (!is_finite(s.direction) || !is_finite(s.weight) || !std::isfinite(s.density) || s.density < 0 ||
        glm::min(s.weight.x, glm::min(s.weight.y, s.weight.z)) < 0 || s.draws < 1)
      ++wrong;
    length = std::max(length, std::abs(glm::length(s.direction) - 1));
    if (at_jump(strategy, at, s.direction)) continue;
    const double right = density(strategy, at, s.direction);
    if (right <= smallest_density) continue;
    const double error = std::abs(s.density - right) / right;
    const double condition = lobe_condition(at.model.exponent, at.fixed, s.direction);
    if (condition < well_conditioned)
      worst = std::max(worst, error);
    else
      edge = std::max(edge, error / edge_error(condition));
  }
  subject.report.record(strategy.name, "densities", worst, density_error, drawn.where);
  // Near alpha = pi / 2, where float32 is less accurate than 1e-5: in units of its error.
  subject.report.record(strategy.name, "edge", edge, 1, drawn.where);
  subject.report.record(strategy.name, "unit", length, unit_error, drawn.where);
  subject.report.record(strategy.name, "finite", wrong, 0, drawn.where);
}

} // namespace phlux::verify
