// The light tree that the host builds.
#include "tables/light_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace phlux;
using scene::Vec3;
using tables::LightBounds;

namespace {

std::vector<LightBounds> points(int count, const Vec3& from, const Vec3& step) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = from + static_cast<double>(i) * step;
    lights.push_back({i, at, at, Vec3(0, 0, 1), std::numbers::pi, 1.0 + i});
  }
  return lights;
}

// Checks the properties that kernels rely on; returns the depth of the deepest leaf.
int check_tree(const std::vector<LightBounds>& lights) {
  std::vector<LightRecord> records(lights.size());
  const std::vector<LightNodeRecord> nodes = tables::light_tree(lights, records);
  REQUIRE(nodes.size() == 2 * lights.size());
  int deepest = 0;
  for (std::size_t light = 0; light < lights.size(); ++light) {
    int node = records[light].node, depth = 0;
    REQUIRE(nodes.at(static_cast<std::size_t>(node)).child == ~static_cast<int>(light));
    while (node > 0) {
      const LightNodeRecord& here = nodes[static_cast<std::size_t>(node)];
      const LightNodeRecord& parent = nodes.at(static_cast<std::size_t>(here.parent));
      REQUIRE((parent.child == node || parent.child == (node ^ 1)));
      REQUIRE(parent.intensity >= here.intensity);
      for (int axis = 0; axis < 3; ++axis)
        REQUIRE(std::abs(here.center[axis] - parent.center[axis]) + here.half_size[axis] <=
                parent.half_size[axis] * (1 + 1e-5f) + 1e-3f);
      node = here.parent;
      ++depth;
    }
    deepest = std::max(deepest, depth);
  }
  CHECK(nodes[0].intensity == Approx(1));
  return deepest;
}

} // namespace

TEST_CASE("a tree of lights has a leaf for each, in boxes of which one holds the other") {
  CHECK(check_tree(points(2, {0, 0, 0}, {1, 2, 3})) == 1);
  CHECK(check_tree(points(1000, {-500, 3, 2}, {1, 0.5, 0.25})) < 20);
}

// Boxes without area give no criterion for splitting.
TEST_CASE("thousands of point lights in a row, or at one place, make no deep tree") {
  CHECK(check_tree(points(4000, {-2000, 0, 0}, {1, 0, 0})) < 24);
  CHECK(check_tree(points(4000, {1, 2, 3}, {0, 0, 0})) < 24);
}

TEST_CASE("with one light there is no choice") {
  std::vector<LightRecord> records(1);
  CHECK(tables::light_tree(points(1, {0, 0, 0}, {0, 0, 0}), records).empty());
  CHECK(tables::light_tree({}, records).empty());
}
