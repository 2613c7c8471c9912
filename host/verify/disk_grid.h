// CW 197's grid for verification: squares of the (x, y) coordinates of the hemisphere, with a quadrature.
#pragma once

#include <vector>

#include "measure/sphere_grid.h"
#include "verify/model.h"

namespace phlux::verify {

/// A square grid of side * side cells over part of the (x, y) plane; side is odd, so that the axis of a lobe
/// in its middle is inside a cell. Cells are numbered along x first.
class DiskGrid {
public:
  DiskGrid(double middle_x, double middle_y, double half_width, int side);

  [[nodiscard]] std::size_t side() const { return static_cast<std::size_t>(side_); }
  [[nodiscard]] std::size_t cells() const { return side() * side(); }
  /// The cell of a direction above the surface; cells() for those outside the grid.
  [[nodiscard]] std::size_t cell_of(const Direction& direction) const;
  [[nodiscard]] double x(std::size_t cell) const; ///< middle of the cell
  [[nodiscard]] double y(std::size_t cell) const;

  /// Quadrature nodes, whose weights are solid angles: a rule in each cell, subdivided near the lobe of this
  /// exponent and, for wide lobes, at alpha = pi / 2.
  [[nodiscard]] std::vector<Node> nodes(double exponent, const Direction& fixed) const;

private:
  struct Square {
    double x0, x1, y0, y1;
  };
  [[nodiscard]] Square square(std::size_t cell) const;
  void add_nodes(std::vector<Node>& list, const Square& s, std::size_t cell, double exponent,
                 const Direction& fixed, int depth) const;

  double x0_, y0_, step_;
  int side_;
};

} // namespace phlux::verify
