#include <algorithm>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "scene/digest.h"
#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

std::string mesh(const std::string& transform, const std::string& property = "") {
  return "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/><ref id=\"red\"/>" + property +
         "<transform name=\"toWorld\">" + transform + "</transform></shape>";
}
std::string flipped_mesh(const std::string& transform) {
  return mesh(transform, "<boolean name=\"flipNormals\" value=\"true\"/>");
}
std::string ball(const std::string& transform, const std::string& centre = "1 2 3") {
  return "<shape type=\"sphere\"><point name=\"center\" value=\"" + centre +
         "\"/><emitter type=\"area\"/><transform name=\"toWorld\">" + transform + "</transform></shape>";
}
std::string cube(const std::string& transform) {
  return "<shape type=\"cube\"><transform name=\"toWorld\">" + transform + "</transform></shape>";
}
std::string instance(const std::string& transform) {
  return "<shape type=\"instance\"><ref id=\"group\"/><transform name=\"toWorld\">" + transform +
         "</transform></shape>";
}

const std::string red =
    "<bsdf type=\"diffuse\" id=\"red\"><rgb name=\"reflectance\" value=\".5 0 0\"/></bsdf>";
const std::string own = "<rotate y=\"1\" angle=\"40\"/><translate x=\"1\"/>";
const std::string twice = "<scale value=\"2\"/>",
                  turned = "<scale value=\"-.5\"/><rotate x=\"1\" angle=\"70\"/>";

phlux::scene::Scene scene_of(const std::string& body, const std::string& version = "0.6.0") {
  return load_files({{"scene.xml", with_sensor(red + body, version)}, {"m.obj", obj}});
}

} // namespace

TEST_CASE("Instances are the scene of copies made by hand") {
  const std::string group =
      "<shape type=\"shapegroup\" id=\"group\">" + mesh(own) + cube(own) + ball(own) + "</shape>";
  const auto instances = scene_of(group + instance(twice) + instance(turned));
  const auto copies =
      scene_of(mesh(own + twice) + cube(own + twice) + ball(own + twice) + flipped_mesh(own + turned) +
               cube(own + turned) + ball(own + turned, "2 4 6")); // 0.6 scales the centre's inverse
  REQUIRE(instances.meshes.size() == 2);
  for (const std::size_t i : {0u, 1u}) {
    const auto &one = instances.meshes[i], &other = copies.meshes.at(i);
    CHECK(one.triangles == other.triangles);
    for (std::size_t k = 0; k < one.positions.size(); ++k) {
      CHECK(glm::distance(one.positions[k], other.positions.at(k)) < 1e-14);
      CHECK(glm::distance(one.normals.at(k), other.normals.at(k)) < 1e-6f);
    }
  }
  CHECK(instances.spheres.at(0).radius == copies.spheres.at(0).radius);
  CHECK(instances.area_emitters.size() == 2);
  const std::string round = "<shape type=\"shapegroup\" id=\"group\">" + cube(own) + ball(own) + "</shape>";
  const auto instances3 = scene_of(round + instance(twice) + instance(turned), "3.0.0");
  auto copies3 =
      scene_of(cube(own + twice) + ball(own + twice) + cube(own + turned) + ball(own + turned), "3.0.0");
  // A sphere's own transform that mirrors turns its front inside, that of an instance does not (Mitsuba 3).
  CHECK(copies3.spheres.at(1).front_is_inside);
  copies3.spheres[1].front_is_inside = false;
  CHECK(phlux::scene::digest(instances3) == phlux::scene::digest(copies3));
}

// Of n = (1, 0, 0) and (0, 1, 0), which the scale takes to (1/4, 0, 0) and (0, 1, 0), the mean is (1, 1, 0) /
// 2 before it and (1, 4, 0) / 8 after it.
TEST_CASE("Instances that scale axes differently: the interpolated normal is transformed, as in Mitsuba") {
  const std::string normals = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nvn 0 1 0\nf 1//1 2//2 3//2\n";
  const auto scene =
      load_files({{"scene.xml", with_sensor(red + "<shape type=\"shapegroup\" id=\"group\">" + mesh("") +
                                            "</shape>" + instance("<scale x=\"4\"/>"))},
                  {"m.obj", normals}});
  const auto& mesh = scene.meshes.at(0);
  const glm::vec3 first = mesh.normals[mesh.triangles.at(0)[0]], second = mesh.normals[mesh.triangles[0][1]];
  CHECK(glm::distance(glm::normalize(first + second), glm::normalize(glm::vec3(1, 4, 0))) < 1e-6f);
  CHECK(std::max(glm::length(first), glm::length(second)) == Approx(1));
}

TEST_CASE("Instances that mirror keep the front side of meshes without normals, as in Mitsuba") {
  const std::string group = "<shape type=\"shapegroup\" id=\"group\">" + mesh("") + "</shape>";
  const auto sum = [&](const std::string& transform) {
    const auto mesh = scene_of(group + instance(transform)).meshes.at(0);
    double volume = 0; // six times that of the tetrahedron, negative if its front is inside
    for (const auto& t : mesh.triangles)
      volume += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]));
    return volume;
  };
  CHECK(sum("") == Approx(1));
  CHECK(sum("<scale x=\"-2\"/>") == Approx(2));
  CHECK(sum("<scale value=\"-1\"/>") == Approx(1));
}

TEST_CASE("Instances: what is wrong with them, and the memory of copies") {
  CHECK_THAT(error_in("<shape type=\"instance\"/>"),
             StartsWith("scene.xml:2: <shape type=\"instance\"> without a reference"));
  CHECK_THAT(error_in("<shape type=\"sphere\" id=\"group\"/>\n" + instance(twice)),
             StartsWith("scene.xml:3: "));
  CHECK_THAT(error_in("<shape type=\"shapegroup\" id=\"inner\"/><shape type=\"shapegroup\" "
                      "id=\"group\">\n<shape type=\"instance\">"
                      "<ref id=\"inner\"/></shape></shape>" +
                      instance(twice)),
             StartsWith("scene.xml:3: <shape type=\"instance\"> inside a shapegroup"));
  CHECK_THAT(error_in("<shape type=\"shapegroup\" id=\"group\">\n<shape type=\"torus\"/></shape>" +
                      instance(twice) + instance(turned)),
             StartsWith("scene.xml:3: <shape type=\"torus\"> is not supported: supported"));
  CHECK(scene_of("<shape type=\"shapegroup\" id=\"group\">" + mesh("") + "</shape>").meshes.empty());
  const std::string group = "<shape type=\"shapegroup\" id=\"group\">" + mesh("") + "</shape>";
  CHECK_THAT(log_of_files({{"scene.xml", with_sensor(red + group + instance(twice) + instance(turned))},
                           {"m.obj", obj}}),
             Contains("instances are copies: 8 triangles, about 0 MB"));
}
