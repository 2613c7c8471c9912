// A grid of cells over the sphere of directions, with a quadrature rule in each cell.
#pragma once

#include <array>
#include <vector>

#include "measure/directions.h"

namespace phlux::measure {

struct Node {
  Direction direction;
  double weight = 0; ///< solid angle
  std::size_t cell = 0;
};

/// Cells between angles from an axis, between longitudes about it, and above or below the horizon; the normal
/// is z. The horizon and its mirror image about the axis, where densities are not smooth, are edges.
class SphereGrid {
public:
  static constexpr int longitudes = 12;

  /// `cuts`: further angles in (0, pi) from the axis that bound cells, where a density varies fast.
  SphereGrid(const Direction& axis, std::vector<double> cuts);

  [[nodiscard]] std::size_t cells() const { return (angles_.size() - 1) * longitudes * 2; }
  [[nodiscard]] std::size_t cell_of(const Direction& direction) const;
  [[nodiscard]] std::vector<Node> nodes() const;

  /// Bounds of a cell: angles and longitudes in radians, and the side of the horizon.
  struct Bounds {
    double angle_from, angle_to, longitude_from, longitude_to;
    bool above;
  };
  [[nodiscard]] Bounds bounds(std::size_t cell) const;

private:
  [[nodiscard]] Direction direction(double angle, double longitude) const;
  void add_circle(std::vector<Node>& list, std::size_t ring, double angle, double weight) const;

  Direction x_, y_, z_; // x_ points from the normal, across the axis
  std::vector<double> angles_;
};

/// Angles outside which a lobe cos^n has given shares of its integral.
[[nodiscard]] std::vector<double> lobe_cuts(double exponent);

/// Nodes (position, weight) of the Gauss-Legendre rule on [from, to].
template<std::size_t points>
[[nodiscard]] std::array<std::array<double, 2>, points> gauss_nodes(double from, double to);

} // namespace phlux::measure
