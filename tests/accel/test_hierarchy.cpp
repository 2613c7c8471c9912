// Hierarchies, traversed as kernels do.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

#include "accel/shapes.h"
#include "errors.h"

using namespace accel_test;
using accel::Geometry;

namespace {

struct Box {
  float low[3], high[3];
  [[nodiscard]] bool is_empty() const { return low[0] > high[0]; }
  [[nodiscard]] bool holds(const accel::Box& other) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (low[axis] > other.low[axis] || high[axis] < other.high[axis]) return false;
    return true;
  }
};

// Traverses a hierarchy from its root and compares it with the shapes.
class Walk {
public:
  Walk(const Shapes& shapes, const Geometry& geometry)
      : shapes_(shapes), geometry_(geometry),
        children_(static_cast<std::size_t>(std::max(geometry.block, 2))) {
    visit(geometry.root, {});
  }

  std::multiset<int> materials; // of the primitives of leaves
  std::size_t depth = 0, nodes = 0;

private:
  void visit(int child, const std::vector<Box>& above) {
    depth = std::max(depth, above.size());
    if (child < 0) {
      visit_leaf(~child, above);
      return;
    }
    ++nodes;
    const auto node = static_cast<std::size_t>(child);
    REQUIRE((node + 1) * NODE_WORDS * children_ <= geometry_.nodes.size());
    bool ended = false;
    for (std::size_t i = 0; i < children_; ++i) {
      const Box box = box_of(node, i);
      if (box.is_empty()) {
        ended = true; // unused children are the last ones
        continue;
      }
      REQUIRE_FALSE(ended);
      std::vector<Box> boxes = above;
      boxes.push_back(box);
      visit(std::bit_cast<int>(word(node, NODE_CHILD, i)), boxes);
    }
  }

  void visit_leaf(int leaf, const std::vector<Box>& above) {
    const int kind = leaf & 3, blocks = (leaf >> 2 & 7) + 1, first = (leaf >> 5) * geometry_.block;
    const bool spheres = kind == LEAF_SPHERES;
    const int offset = spheres ? geometry_.first_sphere : 0;
    const int end = spheres ? geometry_.sphere_count : geometry_.first_sphere;
    REQUIRE(first + blocks * geometry_.block <= end);
    for (int i = first; i < first + blocks * geometry_.block; ++i) {
      const PrimitiveRecord& record = geometry_.primitives[static_cast<std::size_t>(offset + i)];
      if (record.region == REGION_NONE) continue;
      if (!spheres) REQUIRE(record.region == kind);
      materials.insert(record.material);
      const auto reference = shapes_.references.at(static_cast<std::size_t>(record.material));
      REQUIRE(spheres == (reference.kind == accel::Reference::Kind::sphere));
      const accel::Box bounds = accel::bounds(shapes_.scene, geometry_.origin, reference);
      for (const Box& box : above) REQUIRE(box.holds(bounds));
    }
  }

  [[nodiscard]] float word(std::size_t node, std::size_t k, std::size_t i) const {
    return geometry_.nodes[(node * NODE_WORDS + k) * children_ + i];
  }
  [[nodiscard]] Box box_of(std::size_t node, std::size_t i) const {
    return {{word(node, NODE_LOW_X, i), word(node, NODE_LOW_Y, i), word(node, NODE_LOW_Z, i)},
            {word(node, NODE_HIGH_X, i), word(node, NODE_HIGH_Y, i), word(node, NODE_HIGH_Z, i)}};
  }

  const Shapes& shapes_;
  const Geometry& geometry_;
  std::size_t children_;
};

void check_hierarchy(const Shapes& shapes, int lanes) {
  const Geometry geometry = accel::hierarchy(shapes.scene, lanes);
  CAPTURE(lanes, shapes.references.size());
  const Walk walk(shapes, geometry);
  std::multiset<int> all;
  for (int i = 0; i < static_cast<int>(shapes.references.size()); ++i) all.insert(i);
  CHECK(walk.materials == all);
  CHECK(walk.depth <= static_cast<std::size_t>(lanes == 1 ? accel::max_depth_binary : accel::max_depth_wide));
  const auto node_words = static_cast<std::size_t>(NODE_WORDS * std::max(lanes, 2));
  CHECK(walk.nodes * node_words == geometry.nodes.size());
  CHECK(geometry.primitive_count == shapes.references.size());
}

constexpr int widths[] = {1, 4, 8, 16};

} // namespace

TEST_CASE("every primitive is in one leaf of a hierarchy, in the boxes of all nodes above it") {
  for (const int lanes : widths) {
    check_hierarchy(random_shapes(1, 0, 0), lanes);
    check_hierarchy(random_shapes(0, 0, 1), lanes);
    check_hierarchy(random_shapes(1, 1, 1), lanes);
    check_hierarchy(random_shapes(0, 300, 0), lanes);
    check_hierarchy(random_shapes(1000, 100, 100), lanes);
  }
}

TEST_CASE("the depth of the hierarchy of coincident shapes is within the stack of the kernels") {
  Shapes shapes;
  for (int i = 0; i < 500; ++i) {
    shapes.add_sphere({0, 0, 0}, 1);
    shapes.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  }
  for (const int lanes : widths) check_hierarchy(shapes, lanes);
}

TEST_CASE("tables are whole blocks, padded with primitives that no ray hits") {
  const Shapes shapes = random_shapes(50, 21, 13);
  for (const int lanes : widths) {
    CAPTURE(lanes);
    const Geometry geometry = accel::hierarchy(shapes.scene, lanes);
    const auto flats = static_cast<std::size_t>(geometry.first_sphere),
               spheres = static_cast<std::size_t>(geometry.sphere_count);
    CHECK(geometry.block == lanes);
    CHECK(geometry.first_sphere % lanes == 0);
    CHECK(geometry.sphere_count % lanes == 0);
    REQUIRE(geometry.primitives.size() == flats + spheres);
    CHECK(geometry.emitters.size() == flats + spheres);
    CHECK(geometry.planars.size() == flats * PLANAR_FLOATS);
    CHECK(geometry.spheres.size() == spheres * SPHERE_FLOATS);
    const auto block = static_cast<std::size_t>(lanes);
    for (std::size_t i = 0; i < geometry.primitives.size(); ++i) {
      if (geometry.primitives[i].region != REGION_NONE) continue;
      const bool sphere = i >= flats;
      const std::size_t at = sphere ? i - flats : i;
      if (sphere)
        CHECK(geometry.spheres[(at / block * SPHERE_FLOATS + SPHERE_RADIUS) * block + at % block] == 0);
      else
        for (std::size_t k = 0; k < 3; ++k)
          CHECK(geometry.planars[(at / block * PLANAR_FLOATS + PLANAR_NORMAL + k) * block + at % block] == 0);
    }
  }
}

TEST_CASE("a scene without shapes has no hierarchy, and shapes without area are in no leaf") {
  CHECK_THROWS_AS(accel::hierarchy({}, 4), SceneError);
  Shapes shapes = random_shapes(20, 0, 0);
  const std::size_t with_area = shapes.references.size();
  for (int i = 0; i < 40; ++i) { // in single leaves, the first and the last included
    shapes.add_triangle(scene::Vec3(100 + i), scene::Vec3(101 + i), scene::Vec3(102 + i));
    shapes.add_triangle(scene::Vec3(-100 - i), scene::Vec3(-101 - i), scene::Vec3(-102 - i));
  }
  for (const int lanes : widths) {
    CAPTURE(lanes);
    const Geometry geometry = accel::hierarchy(shapes.scene, lanes);
    CHECK(geometry.primitive_count == with_area);
    CHECK(Walk(shapes, geometry).materials.size() == with_area);
  }
}
