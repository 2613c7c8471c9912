// Tables for testing every primitive in turn.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "accel/shapes.h"

using namespace accel_test;
using accel::Geometry;
using scene::Vec3;

namespace {

// Corner or centre of a flat primitive, and its edges, from its values.
struct Planar {
  Vec3 origin, edge_u, edge_v;
};
Planar planar(const Geometry& geometry, std::size_t index, double cross_length) {
  const float* values = geometry.planars.data() + index * PLANAR_FLOATS;
  const auto vector = [&](int first) { return Vec3(values[first], values[first + 1], values[first + 2]); };
  return {vector(PLANAR_ORIGIN), -cross_length * vector(PLANAR_MINUS_U),
          cross_length * vector(PLANAR_EDGE_V)};
}

void check_near(const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis) CHECK(a[axis] == Approx(b[axis]).margin(1e-5));
}

} // namespace

TEST_CASE("regions come in their order, then spheres, without fillers") {
  const Geometry geometry = accel::brute_force(random_shapes(7, 10, 3).scene);
  CHECK(geometry.block == 1);
  CHECK(geometry.triangle_end == 7);
  CHECK(geometry.parallelogram_end == 12);
  CHECK(geometry.ellipse_end == 17);
  CHECK(geometry.first_sphere == 17);
  CHECK(geometry.sphere_count == 3);
  CHECK(geometry.primitive_count == 20);
  REQUIRE(geometry.primitives.size() == 20);
  for (int i = 0; i < 17; ++i)
    CHECK(geometry.primitives[static_cast<std::size_t>(i)].region == (i < 7    ? REGION_TRIANGLE
                                                                      : i < 12 ? REGION_PARALLELOGRAM
                                                                               : REGION_ELLIPSE));
  CHECK(geometry.nodes.empty());
  CHECK(geometry.has_triangles);
  CHECK(geometry.has_parallelograms);
  CHECK(geometry.has_ellipses);
  CHECK_FALSE(accel::brute_force(random_shapes(1, 0, 1).scene).has_ellipses);
}

TEST_CASE(
    "a primitive's values are its corner or centre, its edges and its normal about the scene's middle") {
  Shapes shapes;
  shapes.add_triangle({10, 0, 0}, {12, 0, 0}, {10, 3, 0});
  shapes.add_patch(scene::Patch::Region::parallelogram, {11, 1, 4}, {0.5, 0, 0}, {0, 0, 2});
  shapes.add_sphere({11, 1, 1}, 0.25);
  const Geometry geometry = accel::brute_force(shapes.scene);
  check_near(geometry.origin, {11, 1.5, 3});
  const Planar triangle = planar(geometry, 0, 6);
  check_near(triangle.origin, Vec3(10, 0, 0) - geometry.origin);
  check_near(triangle.edge_u, {2, 0, 0});
  check_near(triangle.edge_v, {0, 3, 0});
  CHECK(geometry.planars[PLANAR_NORMAL + 2] == 1);
  const Planar parallelogram = planar(geometry, 1, 1);
  check_near(parallelogram.origin, Vec3(11, 1, 4) - geometry.origin);
  check_near(parallelogram.edge_u, {0.5, 0, 0});
  check_near(parallelogram.edge_v, {0, 0, 2});
  CHECK(geometry.planars[PLANAR_FLOATS + PLANAR_NORMAL + 1] == -1);
  check_near({geometry.spheres[0], geometry.spheres[1], geometry.spheres[2]},
             Vec3(11, 1, 1) - geometry.origin);
  CHECK(geometry.spheres[SPHERE_RADIUS] == 0.25F);

  const Geometry in_double = accel::brute_force(shapes.scene, true);
  CHECK(in_double.planars.empty());
  CHECK(in_double.spheres.empty());
  REQUIRE(in_double.double_planars.size() == geometry.planars.size());
  for (std::size_t i = 0; i < geometry.planars.size(); ++i)
    CHECK(in_double.double_planars[i] == Approx(static_cast<double>(geometry.planars[i])).margin(1e-6));
}

TEST_CASE("boxes hold their primitives, and the radius all of them, though floats are rounded") {
  const Shapes shapes = random_shapes(100, 100, 100);
  const Geometry geometry = accel::brute_force(shapes.scene);
  const Vec3 origin = accel::middle(shapes.scene);
  CHECK(origin == geometry.origin);
  const auto check_inside = [&](std::size_t material, const Vec3& point) {
    const accel::Box box = accel::bounds(shapes.scene, origin, shapes.references[material]);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      REQUIRE(static_cast<double>(box.low[k]) <= point[axis] - origin[axis]);
      REQUIRE(static_cast<double>(box.high[k]) >= point[axis] - origin[axis]);
    }
    REQUIRE(glm::length(point - origin) <= geometry.radius);
  };
  std::size_t material = 0;
  for (const scene::Mesh& mesh : shapes.scene.meshes) {
    for (const Vec3& corner : mesh.positions) check_inside(material, corner);
    ++material;
  }
  constexpr int directions = 64;
  for (const scene::Patch& patch : shapes.scene.patches) {
    const bool ellipse = patch.region == scene::Patch::Region::ellipse;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / directions, c = std::cos(angle), s = std::sin(angle);
      const double reach = ellipse ? 1 : 1 / std::max(std::abs(c), std::abs(s));
      check_inside(material, patch.origin + reach * (c * patch.edge_u + s * patch.edge_v));
    }
    ++material;
  }
  for (const scene::Sphere& sphere : shapes.scene.spheres) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vec3 point = sphere.center;
        point[axis] += side * sphere.radius;
        check_inside(material, point);
      }
    ++material;
  }
}

TEST_CASE("shapes without area in single precision are left out") {
  Shapes shapes;
  shapes.add_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  shapes.add_patch(scene::Patch::Region::ellipse, {0, 0, 0}, {1e-30, 0, 0}, {0, 1e-30, 0});
  shapes.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK(accel::count_primitives(shapes.scene) == 3);
  const Geometry geometry = accel::brute_force(shapes.scene);
  CHECK(geometry.primitive_count == 1);
  REQUIRE(geometry.primitives.size() == 1);
  CHECK(geometry.primitives[0].material == 2);
}

TEST_CASE("emitters are listed in the order of the primitives, with their areas, boxes and normals") {
  Shapes shapes = random_shapes(1, 0, 0);
  shapes.add_sphere({1, 2, 3}, 2);
  shapes.add_patch(scene::Patch::Region::ellipse, {0, 0, 0}, {2, 0, 0}, {0, 3, 0});
  shapes.add_patch(scene::Patch::Region::parallelogram, {0, 0, 0}, {1, 0, 0}, {0, 0, 2});
  shapes.scene.spheres[0].surface.area_emitter = 5;
  shapes.scene.patches[0].surface.area_emitter = 6;
  shapes.scene.patches[1].surface.area_emitter = 7;
  const Geometry geometry = accel::brute_force(shapes.scene);
  CHECK(geometry.emitters == std::vector<int>{-1, 7, 6, 5});
  REQUIRE(geometry.emitting.size() == 3);
  CHECK(geometry.emitting[0].area == Approx(8));
  CHECK(geometry.emitting[1].area == Approx(6 * std::numbers::pi));
  CHECK(geometry.emitting[2].area == Approx(16 * std::numbers::pi));
  check_near(geometry.emitting[0].normal, {0, -1, 0});
  check_near(geometry.emitting[1].normal, {0, 0, 1});
  CHECK(geometry.emitting[2].normal == Vec3(0.0));
  check_near(geometry.emitting[0].low + geometry.origin, {-1, 0, -2});
  check_near(geometry.emitting[2].high + geometry.origin, {3, 4, 5});
}

TEST_CASE("triangles refer to the normals of their vertices, flat shapes to none") {
  Shapes shapes = random_shapes(1, 1, 1);
  scene::Mesh smooth = shapes.scene.meshes[0];
  smooth.normals.assign(3, {0, 0, 1});
  smooth.triangles = {{2, 0, 1}, {0, 1, 2}};
  shapes.scene.meshes = {smooth, shapes.scene.meshes[0], smooth};
  const Geometry geometry = accel::brute_force(shapes.scene);
  CHECK(geometry.vertex_normals.size() == 18);
  CHECK(geometry.corners == std::vector<int>{2, 0, 1, 0, 1, 2, -1, -1, -1, 5, 3, 4, 3, 4, 5, -1, -1, -1});
  CHECK(accel::brute_force(random_shapes(1, 1, 1).scene).corners.empty());
}
