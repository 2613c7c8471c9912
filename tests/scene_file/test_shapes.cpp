#include <catch2/catch.hpp>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Patch;
using phlux::scene::Vec3;

namespace {

const std::string mirrored = R"(<transform name="toWorld"><scale z="-1"/></transform>)";
const std::string flipped = R"(<boolean name="flipNormals" value="true"/>)";

std::string shape(const std::string& type, const std::string& inside = "") {
  return "<shape type=\"" + type + "\">\n" + inside + "</shape>";
}

Vec3 front(const Patch& patch) {
  return glm::normalize(glm::cross(patch.edge_u, patch.edge_v));
}

bool faces_outwards(const phlux::scene::Scene& cube) {
  for (const auto& face : cube.patches)
    if (glm::dot(front(face), face.origin) < 0.0) return false;
  return true;
}

} // namespace

TEST_CASE("A rectangle is [-1, 1]^2, a disk has radius 1, and both face +z") {
  const auto rectangle = load_body(shape("rectangle")).patches.at(0);
  CHECK(rectangle.region == Patch::Region::parallelogram);
  CHECK(rectangle.origin == Vec3(0.0));
  CHECK(rectangle.edge_u == Vec3(1, 0, 0));
  CHECK(rectangle.edge_v == Vec3(0, 1, 0));
  const auto disk = load_body(shape("disk")).patches.at(0);
  CHECK(disk.region == Patch::Region::ellipse);
  CHECK(glm::length(disk.edge_u) == 1.0);
  CHECK(front(disk) == Vec3(0, 0, 1));
}

TEST_CASE("The front side of flat shapes under flipNormals and mirroring") {
  for (const char* type : {"rectangle", "disk"}) {
    CHECK(front(load_body(shape(type, flipped)).patches.at(0)) == Vec3(0, 0, -1));
    CHECK(front(load_body(shape(type, mirrored)).patches.at(0)) ==
          Vec3(0, 0, -1)); // z is mirrored, and with it +z
    CHECK(front(load_body(shape(type, mirrored + flipped)).patches.at(0)) == Vec3(0, 0, 1));
    const std::string sideways = R"(<transform name="toWorld"><scale x="-1"/></transform>)";
    CHECK(front(load_body(shape(type, sideways)).patches.at(0)) == Vec3(0, 0, 1)); // +z is not
  }
}

TEST_CASE("A cube is [-1, 1]^3 and faces outwards, inwards with flipNormals, whether mirrored or not") {
  const auto cube = load_body(shape("cube"));
  REQUIRE(cube.patches.size() == 6);
  Vec3 sum(0.0);
  for (const auto& face : cube.patches) {
    sum += face.origin;
    CHECK(glm::length(face.origin) == 1.0);
    CHECK(front(face) == face.origin);
  }
  CHECK(sum == Vec3(0.0));
  CHECK(faces_outwards(load_body(shape("cube", mirrored))));
  CHECK_FALSE(faces_outwards(load_body(shape("cube", flipped))));
  CHECK_FALSE(faces_outwards(load_body(shape("cube", mirrored + flipped))));
}

TEST_CASE("Spheres: centre, radius, a toWorld of uniform scale") {
  const std::string placed = R"(<point name="center" x="1" y="2" z="3"/><float name="radius" value="2"/>)";
  const auto sphere = load_body(shape("sphere", placed)).spheres.at(0);
  CHECK(sphere.center == Vec3(1, 2, 3));
  CHECK(sphere.radius == 2.0);
  CHECK_FALSE(sphere.front_is_inside);
  CHECK(load_body(shape("sphere", flipped)).spheres.at(0).front_is_inside);
  CHECK_FALSE(load_body(shape("sphere", mirrored)).spheres.at(0).front_is_inside);
  CHECK(load_body(shape("sphere", mirrored), "3.0.0").spheres.at(0).front_is_inside); // as in Mitsuba 3
  CHECK_FALSE(load_body(shape("sphere", mirrored + flipped), "3.0.0").spheres.at(0).front_is_inside);

  const std::string scaled = R"(<transform name="toWorld"><scale value="3"/><translate x="10"/></transform>)";
  CHECK(load_body(shape("sphere", placed + scaled)).spheres.at(0).radius == Approx(6.0));
  CHECK(load_body(shape("sphere", placed + scaled)).spheres.at(0).center.x ==
        Approx(11.0)); // 0.6 does not scale it
  CHECK(load_body(shape("sphere", placed + scaled), "3.0.0").spheres.at(0).center.x == Approx(13.0));

  CHECK_THAT(error_in(shape("sphere", "<transform name=\"toWorld\"><scale x=\"2\"/></transform>")),
             StartsWith("scene.xml:3: ") && Contains("ellipsoid"));
  for (const char* radius : {"0", "-1"})
    CHECK_THAT(error_in(shape("sphere", "<float name=\"radius\" value=\"" + std::string(radius) + "\"/>")),
               StartsWith("scene.xml:3: <shape type=\"sphere\">: radius: "));
}

TEST_CASE("Shapes that are not supported, or wrongly given") {
  CHECK_THAT(error_in("\n" + shape("torus")),
             StartsWith("scene.xml:3: <shape type=\"torus\"> is not supported: supported are cube, cylinder, "
                        "disk, instance, obj, ply, rectangle, "));
  CHECK_THAT(error_in(shape("disk", "<float name=\"radius\" value=\"2\"/>")),
             StartsWith("scene.xml:3: 'radius' is not a property"));
  CHECK_THAT(error_in(shape("ply")), StartsWith("scene.xml:2: <shape type=\"ply\"> without a filename"));
  CHECK_THAT(error_in(shape("obj", "<string name=\"filename\" value=\"absent.obj\"/>")),
             StartsWith("scene.xml:3: mesh file '") && Contains("absent.obj' cannot be read"));
}

TEST_CASE("The texture of a cylinder begins where Mitsuba's does") {
  for (const char* version : {"0.6.0", "3.0.0"})
    CHECK(glm::length(load_body(shape("cylinder", ""), version).meshes.at(0).positions.at(0) -
                      Vec3(1, 0, 0)) < 1e-4);
  const std::string ends = R"(<point name="p0" value="0 0 0"/><point name="p1" value="1 2 2"/>)";
  CHECK(glm::length(load_body(shape("cylinder", ends), "3.0.0").meshes.at(0).positions.at(0) -
                    Vec3(14, -2, -5) / 15.0) < 1e-4);
}

TEST_CASE("Cylinders: exact area, vertices near the surface, normals outwards") {
  const std::string tilted = R"(<point name="p0" value="1 2 3"/><point name="p1" value="1 4 3"/>
    <float name="radius" value=".5"/><transform name="toWorld"><rotate x="1" angle="30"/></transform>)";
  for (const bool flip : {false, true}) {
    const std::string sides =
        "<boolean name=\"flipNormals\" value=\"" + std::string(flip ? "true" : "false") + "\"/>";
    const auto mesh = load_body(shape("cylinder", tilted + sides)).meshes.at(0);
    const Vec3 axis = glm::normalize(mesh.positions.at(1) - mesh.positions.at(0));
    CHECK(axis.y == Approx(std::cos(glm::radians(30.0))));
    Vec3 middle(0.0);
    for (std::size_t i = 0; i < 512; ++i)
      middle += mesh.positions[i] / 512.0; // without the seam's repetition
    CHECK(mesh.texture_coordinates.at(256) == glm::vec2(0.5, 0));
    CHECK(mesh.texture_coordinates.at(513) == glm::vec2(1, 1));
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 cross =
          glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
      area += glm::length(cross) / 2.0;
      CHECK((glm::dot(cross, mesh.positions[a] - middle) > 0.0) != flip);
    }
    CHECK(area == Approx(2.0 * std::acos(-1.0) * .5 * 2.0).epsilon(1e-12));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vec3 from_middle = mesh.positions[i] - middle;
      const Vec3 outwards = from_middle - axis * glm::dot(axis, from_middle);
      CHECK(std::abs(glm::length(outwards) - .5) < .5 * 6e-5);
      CHECK(glm::length(glm::normalize(outwards) * (flip ? -1.0 : 1.0) - Vec3(mesh.normals.at(i))) < 1e-6);
    }
  }
  CHECK_THAT(error_in(shape("cylinder", "<point name=\"p1\" x=\"0\" y=\"0\" z=\"0\"/>")),
             Contains("p1: it is the same point as p0"));
  CHECK_THAT(error_in(shape("cylinder", "<float name=\"radius\" value=\"0\"/>")),
             Contains("0.000000 is not positive"));
}
