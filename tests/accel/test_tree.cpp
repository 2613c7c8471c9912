// Properties of the tree built by Embree that the layouts of hierarchies and lights rely on.
#include "accel/tree.h"

#include <algorithm>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "errors.h"

using phlux::accel::Tree;

namespace {

RTCBuildPrimitive cube_at(float x, float y, float z, float half, unsigned number) {
  return {x - half, y - half, z - half, number % 3, x + half, y + half, z + half, number};
}

std::vector<RTCBuildPrimitive> random_cubes(unsigned count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1, 1);
  std::vector<RTCBuildPrimitive> cubes;
  for (unsigned i = 0; i < count; ++i)
    cubes.push_back(cube_at(place(random), place(random), place(random), 0.01F, i));
  return cubes;
}

bool holds(const RTCBounds& box, const RTCBuildPrimitive& p) {
  return box.lower_x <= p.lower_x && box.lower_y <= p.lower_y && box.lower_z <= p.lower_z &&
         box.upper_x >= p.upper_x && box.upper_y >= p.upper_y && box.upper_z >= p.upper_z;
}

struct Walk {
  const Tree::Shape& shape;
  std::multiset<unsigned> found;
  unsigned depth = 0;

  // `boxes`: of the ancestors, each of which must contain all below it.
  void visit(const Tree::Node& node, std::vector<RTCBounds> boxes) {
    depth = std::max(depth, static_cast<unsigned>(boxes.size()));
    if (!node.children.empty()) {
      REQUIRE(node.children.size() >= 2);
      REQUIRE(node.children.size() <= shape.branching);
      REQUIRE(node.boxes.size() == node.children.size());
      REQUIRE(node.primitives.empty());
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        boxes.push_back(node.boxes[i]);
        visit(*node.children[i], boxes);
        boxes.pop_back();
      }
      return;
    }
    REQUIRE_FALSE(node.primitives.empty());
    REQUIRE(node.primitives.size() <= shape.leaf_size);
    REQUIRE(std::ranges::is_sorted(node.primitives, [](const auto& a, const auto& b) {
      return a.geomID != b.geomID ? a.geomID < b.geomID : a.primID < b.primID;
    }));
    for (const RTCBuildPrimitive& p : node.primitives) {
      found.insert(p.primID);
      for (const RTCBounds& box : boxes) REQUIRE(holds(box, p));
    }
  }
};

void check_tree(const std::vector<RTCBuildPrimitive>& primitives, const Tree::Shape& shape) {
  CAPTURE(primitives.size(), shape.branching, shape.leaf_size, shape.block, shape.max_depth);
  const Tree tree(primitives, shape);
  Walk walk{shape, {}};
  walk.visit(tree.root(), {});
  CHECK(walk.depth <= shape.max_depth);
  std::multiset<unsigned> all;
  for (const RTCBuildPrimitive& p : primitives) all.insert(p.primID);
  CHECK(walk.found == all);
}

constexpr Tree::Shape shapes[] = {
    {2, 1, 1, 64}, {2, 4, 1, 63}, {4, 4, 4, 23}, {8, 8, 8, 23}, {16, 16, 16, 23}};

} // namespace

TEST_CASE("every primitive is in one leaf, in the boxes of all nodes above it") {
  for (const Tree::Shape& shape : shapes)
    for (const unsigned count : {1U, 2U, 5U, 17U, 1000U, 20000U}) check_tree(random_cubes(count), shape);
}

TEST_CASE("primitives at one place, and in a row without extent, keep leaves and depth as bounded") {
  for (const Tree::Shape& shape : shapes) {
    std::vector<RTCBuildPrimitive> heap, row;
    for (unsigned i = 0; i < 3000; ++i) {
      heap.push_back(cube_at(1, 2, 3, 0.5F, i));
      row.push_back(cube_at(static_cast<float>(i), 0, 0, 1e-3F, i));
    }
    check_tree(heap, shape);
    check_tree(row, shape);
  }
}

TEST_CASE("a tree without primitives is refused") {
  CHECK_THROWS_AS(Tree({}, shapes[0]), phlux::SceneError);
}
