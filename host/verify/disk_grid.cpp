#include "verify/disk_grid.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace phlux::verify {
namespace {

// Parameters (a, t) of the hemisphere that are smooth up to the rim of the disk: x = sin(a), y = cos(a)
// sin(t), z = cos(a) cos(t), with solid angle cos(a) da dt.
double longitude_at(double y, double cos_a) {
  return std::asin(std::clamp(y / std::max(cos_a, 1e-300), -1.0, 1.0));
}

Direction clamped(double x, double y) { // to the disk
  const double radius = std::hypot(x, y);
  if (radius >= 1) return {x / radius, y / radius, 0};
  return {x, y, std::sqrt(1 - radius * radius)};
}

} // namespace

DiskGrid::DiskGrid(double middle_x, double middle_y, double half_width, int side)
    : x0_(middle_x - half_width), y0_(middle_y - half_width), step_(2 * half_width / side), side_(side) {}

std::size_t DiskGrid::cell_of(const Direction& d) const {
  const double column = std::floor((d.x - x0_) / step_), row = std::floor((d.y - y0_) / step_);
  if (!(column >= 0 && column < side_ && row >= 0 && row < side_)) return cells();
  return static_cast<std::size_t>(row) * side() + static_cast<std::size_t>(column);
}

double DiskGrid::x(std::size_t cell) const {
  return x0_ + step_ * (static_cast<double>(cell % side()) + 0.5);
}
double DiskGrid::y(std::size_t cell) const {
  return y0_ + step_ * (static_cast<double>(cell / side()) + 0.5);
}

DiskGrid::Square DiskGrid::square(std::size_t cell) const {
  return {x(cell) - step_ / 2, x(cell) + step_ / 2, y(cell) - step_ / 2, y(cell) + step_ / 2};
}

std::vector<Node> DiskGrid::nodes(double exponent, const Direction& fixed) const {
  std::vector<Node> list;
  for (std::size_t cell = 0; cell < cells(); ++cell) add_nodes(list, square(cell), cell, exponent, fixed, 0);
  return list;
}

void DiskGrid::add_nodes(std::vector<Node>& list, const Square& s, std::size_t cell, double exponent,
                         const Direction& fixed, int depth) const {
  const double nearest_x = std::clamp(0.0, s.x0, s.x1), nearest_y = std::clamp(0.0, s.y0, s.y1);
  if (std::hypot(nearest_x, nearest_y) >= 1) return;
  // Subdivide squares that are near the lobe and wider than it, or that are crossed by alpha = pi / 2.
  const Direction axis = glm::normalize(Direction(-fixed.x, -fixed.y, fixed.z));
  const Direction middle = clamped((s.x0 + s.x1) / 2, (s.y0 + s.y1) / 2);
  double extent = 0, least = 1, most = -1;
  for (const double x : {s.x0, s.x1})
    for (const double y : {s.y0, s.y1}) {
      const Direction corner = clamped(x, y);
      extent = std::max(extent, glm::length(corner - middle));
      least = std::min(least, glm::dot(corner, axis));
      most = std::max(most, glm::dot(corner, axis));
    }
  const double width = 1 / std::sqrt(exponent + 1);
  const bool near = glm::length(middle - axis) < 7 * width + extent;
  const bool crossed = exponent < 4 && least < 0 && most > 0;
  constexpr int deepest_lobe = 12, deepest_edge = 5;
  if ((near && extent > width && depth < deepest_lobe) || (crossed && depth < deepest_edge)) {
    const double x = (s.x0 + s.x1) / 2, y = (s.y0 + s.y1) / 2;
    for (const Square& quarter : {Square{s.x0, x, s.y0, y}, Square{x, s.x1, s.y0, y},
                                  Square{s.x0, x, y, s.y1}, Square{x, s.x1, y, s.y1}})
      add_nodes(list, quarter, cell, exponent, fixed, depth + 1);
    return;
  }
  // Split the range of a where an edge of the square leaves the disk.
  const double from = std::asin(std::clamp(s.x0, -1.0, 1.0)), to = std::asin(std::clamp(s.x1, -1.0, 1.0));
  std::vector<double> cuts{from, to};
  for (const double y : {s.y0, s.y1})
    if (std::abs(y) < 1)
      for (const double a : {std::acos(std::abs(y)), -std::acos(std::abs(y))})
        if (a > from && a < to) cuts.push_back(a);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    for (const auto& [a, da] : gauss_nodes<4>(cuts[i], cuts[i + 1])) {
      const double t0 = longitude_at(s.y0, std::cos(a)), t1 = longitude_at(s.y1, std::cos(a));
      if (t1 <= t0) continue;
      for (const auto& [t, dt] : gauss_nodes<4>(t0, t1))
        list.push_back({{std::sin(a), std::cos(a) * std::sin(t), std::cos(a) * std::cos(t)},
                        std::cos(a) * da * dt,
                        cell});
    }
}

} // namespace phlux::verify
