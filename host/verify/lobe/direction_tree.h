// Adaptive quadrature over the hemisphere, or the sphere: cells are split where a function varies fast, and
// integrated by the Gauss-Legendre rule.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "verify/model.h"

namespace phlux::verify {

/// Values or integrals of a density, and of f_r |cos| per channel.
struct Integrals {
  double density = 0;
  Rgb reflected{0};

  Integrals& operator+=(const Integrals& other);
};

class DirectionTree {
public:
  /// Values at a batch of directions.
  using Function = std::function<std::vector<Integrals>(const std::vector<Direction>&)>;

  explicit DirectionTree(bool below); ///< `below`: directions below the surface too
  /// Splits the cells about a direction until their sides are about 2^-`levels`.
  void split_about(const Direction& direction, int levels);
  /// Splits cells until none has more than one in 512 of these directions.
  void split_by(const std::vector<Direction>& directions);
  /// Splits cells until a finer rule changes none of their integrals by more than 1e-5.
  void integrate(const Function& function);

  [[nodiscard]] Integrals total() const;
  /// Estimated error of the integrals: root of the sum of squared changes by the last refinements.
  [[nodiscard]] double error() const { return error_; }

  /// The cells of a histogram of so many samples, which join leaves with few expected samples.
  struct Cells {
    std::vector<std::size_t> of_leaf; ///< cell of each node that is a leaf
    std::vector<double> expected;     ///< counts
  };
  [[nodiscard]] Cells cells(double samples) const;
  /// The leaf of a direction, above the surface unless the tree has directions below it.
  [[nodiscard]] std::size_t leaf_of(const Direction& direction) const;

private:
  // A rectangle on a face of the cube about the sphere: 0 is z = 1, 1 to 4 are x = 1, x = -1, y = 1, y = -1,
  // and 5 to 9 are their mirror images in z.
  struct Node {
    int face;
    double a0, a1, b0, b1;
    int level;
    std::size_t first_child = 0; // of four; 0: a leaf
    Integrals integrals;
  };
  void split(std::size_t node);
  [[nodiscard]] std::vector<std::size_t> leaves() const;
  void evaluate(const std::vector<std::size_t>& nodes, const Function& function);
  [[nodiscard]] double refine(std::size_t node);
  void number_cells(std::size_t node, std::size_t cell, double samples, Cells& cells) const;

  std::size_t roots_;
  bool below_;
  std::vector<Node> nodes_;
  double error_ = 0;
};

} // namespace phlux::verify
