#include "verify/lobe/direction_tree.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "measure/sphere_grid.h"

namespace phlux::verify {
namespace {

constexpr int top_side = 4;                    // cells along the edge of the face z = 1
constexpr int side_columns = 4, side_rows = 2; // of the upper half of another face
constexpr std::size_t roots_above = top_side * top_side + 4 * side_columns * side_rows;
constexpr int faces_above = 5;
constexpr int deepest = 18;
constexpr std::size_t most_nodes = 40000;
constexpr double largest_change = 1e-5;
constexpr std::size_t points = 4; // of the quadrature rule, per dimension

struct OnFace {
  int face; // from faces_above on: its mirror image below the surface
  double a, b;
};

OnFace on_face(const Direction& d) {
  if (d.z < 0) {
    OnFace image = on_face(Direction(d.x, d.y, -d.z));
    image.face += faces_above;
    return image;
  }
  const double x = std::abs(d.x), y = std::abs(d.y);
  if (d.z >= std::max(x, y)) return {0, d.x / d.z, d.y / d.z};
  if (x >= y) return {d.x > 0 ? 1 : 2, d.y / x, d.z / x};
  return {d.y > 0 ? 3 : 4, d.x / y, d.z / y};
}

Direction direction_of(const OnFace& p) {
  if (p.face >= faces_above) return direction_of({p.face - faces_above, p.a, p.b}) * Direction(1, 1, -1);
  switch (p.face) {
  case 0:
    return glm::normalize(Direction(p.a, p.b, 1));
  case 1:
    return glm::normalize(Direction(1, p.a, p.b));
  case 2:
    return glm::normalize(Direction(-1, p.a, p.b));
  case 3:
    return glm::normalize(Direction(p.a, 1, p.b));
  default:
    return glm::normalize(Direction(p.a, -1, p.b));
  }
}

// Solid angle per da db.
double solid_angle(double a, double b) {
  return std::pow(1 + a * a + b * b, -1.5);
}

std::size_t step_of(double x, double from, double width, int count) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>((x - from) / width * count), 0, count - 1));
}

std::size_t root_of(const OnFace& p) {
  if (p.face >= faces_above) return roots_above + root_of({p.face - faces_above, p.a, p.b});
  if (p.face == 0) return step_of(p.b, -1, 2, top_side) * top_side + step_of(p.a, -1, 2, top_side);
  const std::size_t first =
      top_side * top_side + static_cast<std::size_t>(p.face - 1) * side_columns * side_rows;
  return first + step_of(p.b, 0, 1, side_rows) * side_columns + step_of(p.a, -1, 2, side_columns);
}

double difference(const Integrals& a, const Integrals& b) {
  const Rgb reflected = glm::abs(a.reflected - b.reflected);
  return std::max({std::abs(a.density - b.density), reflected.r, reflected.g, reflected.b});
}

} // namespace

Integrals& Integrals::operator+=(const Integrals& other) {
  density += other.density;
  reflected += other.reflected;
  return *this;
}

DirectionTree::DirectionTree(bool below) : roots_(below ? 2 * roots_above : roots_above), below_(below) {
  const auto add = [&](int face, int columns, int rows, double b_from) {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double a = 2.0 / columns, b = (1 - b_from) / rows;
        nodes_.push_back({face, -1 + a * column, -1 + a * (column + 1), b_from + b * row,
                          b_from + b * (row + 1), 1, 0, Integrals()});
      }
  };
  for (int first = 0; first <= (below ? faces_above : 0); first += faces_above) {
    add(first, top_side, top_side, -1);
    for (int face = first + 1; face < first + faces_above; ++face) add(face, side_columns, side_rows, 0);
  }
}

void DirectionTree::split(std::size_t node) {
  const Node parent = nodes_[node];
  nodes_[node].first_child = nodes_.size();
  const double a = (parent.a0 + parent.a1) / 2, b = (parent.b0 + parent.b1) / 2;
  for (int quarter = 0; quarter < 4; ++quarter) {
    Node child = parent;
    (quarter % 2 == 0 ? child.a1 : child.a0) = a;
    (quarter / 2 == 0 ? child.b1 : child.b0) = b;
    child.level = parent.level + 1;
    child.first_child = 0;
    nodes_.push_back(child);
  }
}

std::size_t DirectionTree::leaf_of(const Direction& direction) const {
  const OnFace p = on_face(direction);
  std::size_t node = root_of(p);
  while (nodes_[node].first_child != 0) {
    const Node& n = nodes_[node];
    const std::size_t right = p.a >= (n.a0 + n.a1) / 2 ? 1 : 0, upper = p.b >= (n.b0 + n.b1) / 2 ? 2 : 0;
    node = n.first_child + right + upper;
  }
  return node;
}

void DirectionTree::split_about(const Direction& direction, int levels) {
  if (direction.z < 0 && !below_) return;
  for (std::size_t leaf = leaf_of(direction); nodes_[leaf].level < levels; leaf = leaf_of(direction))
    split(leaf);
}

void DirectionTree::split_by(const std::vector<Direction>& directions) {
  const std::size_t most = std::max<std::size_t>(directions.size() / 512, 4);
  for (bool changed = true; changed;) {
    std::vector<std::size_t> counts(nodes_.size());
    for (const Direction& d : directions) ++counts[leaf_of(d)];
    changed = false;
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] > most && nodes_[i].level < deepest) {
        split(i);
        changed = true;
      }
  }
}

std::vector<std::size_t> DirectionTree::leaves() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].first_child == 0) list.push_back(i);
  return list;
}

void DirectionTree::evaluate(const std::vector<std::size_t>& nodes, const Function& function) {
  std::vector<Direction> directions;
  std::vector<double> weights;
  for (const std::size_t node : nodes) {
    const Node& n = nodes_[node];
    for (const auto& [a, da] : gauss_nodes<points>(n.a0, n.a1))
      for (const auto& [b, db] : gauss_nodes<points>(n.b0, n.b1)) {
        directions.push_back(direction_of({n.face, a, b}));
        weights.push_back(da * db * solid_angle(a, b));
      }
  }
  const std::vector<Integrals> values = function(directions);
  for (std::size_t i = 0; i < values.size(); ++i) {
    Integrals& sum = nodes_[nodes[i / (points * points)]].integrals;
    if (i % (points * points) == 0) sum = {};
    sum += {values[i].density * weights[i], values[i].reflected * weights[i]};
  }
}

// Replaces the integrals of a node by the sums over its children; returns the change.
double DirectionTree::refine(std::size_t node) {
  Integrals sum;
  for (std::size_t child = 0; child < 4; ++child) sum += nodes_[nodes_[node].first_child + child].integrals;
  const double change = difference(sum, nodes_[node].integrals);
  nodes_[node].integrals = sum;
  return change;
}

void DirectionTree::integrate(const Function& function) {
  std::vector<std::size_t> pending = leaves();
  evaluate(pending, function);
  double squares = 0;
  while (!pending.empty()) {
    std::vector<std::size_t> children;
    for (const std::size_t node : pending) {
      split(node);
      for (std::size_t child = 0; child < 4; ++child) children.push_back(nodes_[node].first_child + child);
    }
    evaluate(children, function);
    std::vector<std::size_t> next;
    for (const std::size_t node : pending) {
      const double change = refine(node);
      const bool goes_on =
          !(change <= largest_change) && nodes_[node].level + 1 < deepest && nodes_.size() < most_nodes;
      if (goes_on)
        for (std::size_t child = 0; child < 4; ++child) next.push_back(nodes_[node].first_child + child);
      else
        squares += change * change;
    }
    pending = std::move(next);
  }
  error_ = std::sqrt(squares);
  for (std::size_t i = nodes_.size(); i-- > 0;) // children come after their parents
    if (nodes_[i].first_child != 0) static_cast<void>(refine(i));
}

Integrals DirectionTree::total() const {
  Integrals sum;
  for (std::size_t i = 0; i < roots_; ++i) sum += nodes_[i].integrals;
  return sum;
}

// Children with enough expected samples become one or more cells; the others of a node share one.
void DirectionTree::number_cells(std::size_t node, std::size_t cell, double samples, Cells& cells) const {
  constexpr double enough = 25;
  const Node& n = nodes_[node];
  if (n.first_child == 0) {
    cells.of_leaf[node] = cell;
    cells.expected[cell] += samples * n.integrals.density;
    return;
  }
  for (std::size_t child = n.first_child; child < n.first_child + 4; ++child) {
    const bool apart = samples * nodes_[child].integrals.density >= enough;
    if (apart) cells.expected.push_back(0);
    number_cells(child, apart ? cells.expected.size() - 1 : cell, samples, cells);
  }
}

DirectionTree::Cells DirectionTree::cells(double samples) const {
  Cells cells{std::vector<std::size_t>(nodes_.size()), {}};
  for (std::size_t i = 0; i < roots_; ++i) {
    cells.expected.push_back(0);
    number_cells(i, cells.expected.size() - 1, samples, cells);
  }
  return cells;
}

} // namespace phlux::verify
