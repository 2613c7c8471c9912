#include <catch2/catch.hpp>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Rgb;
using phlux::scene::Vec3;

namespace {

const std::string moved = R"(<translate x="1" y="2" z="3"/>)";

std::string to_world(const std::string& steps) {
  return "<transform name=\"toWorld\">" + steps + "</transform>";
}
std::string emitter(const std::string& type, const std::string& inside) {
  return "<emitter type=\"" + type + "\">\n" + inside + "</emitter>";
}

} // namespace

TEST_CASE("Point lights: position or toWorld, intensity 1 unless given") {
  const auto scene = load_body(emitter("point", to_world(moved)) +
                               emitter("point", R"(<point name="position" x="4" y="5" z="6"/>
                                                   <rgb name="intensity" value="1 2 3"/>)"));
  REQUIRE(scene.point_lights.size() == 2);
  CHECK(scene.point_lights[0].position == Vec3(1, 2, 3));
  CHECK(scene.point_lights[0].intensity == Rgb(1.0));
  CHECK(scene.point_lights[1].position == Vec3(4, 5, 6));
  CHECK(scene.point_lights[1].intensity == Rgb(1, 2, 3));
  CHECK_THAT(error_in(emitter("point", "<point name=\"position\" x=\"4\"/>" + to_world(moved))),
             StartsWith("scene.xml:3: ") && Contains("given together with toWorld"));
}

TEST_CASE("Spots: 20 degrees, of which three quarters are beam, unless given") {
  const auto plain =
      load_body(emitter("spot", to_world(R"(<lookat origin="1 2 3" target="1 9 3"/>)"))).spot_lights.at(0);
  CHECK(plain.position == Vec3(1, 2, 3));
  CHECK(glm::length(plain.direction - Vec3(0, 1, 0)) < 1e-12);
  CHECK(plain.cutoff_angle == Approx(glm::radians(20.0)));
  CHECK(plain.beam_width == Approx(glm::radians(15.0)));
  for (const char* names :
       {"<float name=\"cutoffAngle\" value=\"40\"/><float name=\"beamWidth\" value=\"5\"/>",
        "<float name=\"cutoff_angle\" value=\"40\"/><float name=\"beam_width\" value=\"5\"/>"}) {
    const auto spot = load_body(emitter("spot", names)).spot_lights.at(0);
    CHECK(spot.direction == Vec3(0, 0, 1));
    CHECK(spot.cutoff_angle == Approx(glm::radians(40.0)));
    CHECK(spot.beam_width == Approx(glm::radians(5.0)));
  }
  CHECK(
      load_body(emitter("spot", "<float name=\"cutoffAngle\" value=\"40\"/>")).spot_lights.at(0).beam_width ==
      Approx(glm::radians(30.0)));
  CHECK_THAT(error_in(emitter("spot", "<float name=\"beamWidth\" value=\"21\"/>")),
             StartsWith("scene.xml:3: "));
  for (const char* too_narrow : {"0", "0.0009"}) // directions in single precision are too coarse
    CHECK_THAT(
        error_in(emitter("spot", "<float name=\"cutoffAngle\" value=\"" + std::string(too_narrow) + "\"/>")),
        StartsWith("scene.xml:3: ") && Contains("degrees: from 0.001 to 180"));
  CHECK_THAT(error_in(emitter("spot", to_world("<scale value=\"2\"/>"))),
             StartsWith("scene.xml:3: ") && Contains("it scales or shears"));
}

TEST_CASE("Directional lights: direction or toWorld") {
  const auto scene = load_body(emitter("directional", R"(<vector name="direction" x="0" y="-2" z="0"/>)") +
                               emitter("directional", to_world(R"(<rotate x="1" angle="90"/>)") +
                                                          R"(<spectrum name="irradiance" value="3"/>)"));
  REQUIRE(scene.directional_lights.size() == 2);
  CHECK(scene.directional_lights[0].direction == Vec3(0, -1, 0));
  CHECK(scene.directional_lights[0].irradiance == Rgb(1.0));
  CHECK(glm::length(scene.directional_lights[1].direction - Vec3(0, -1, 0)) < 1e-12);
  CHECK(scene.directional_lights[1].irradiance == Rgb(3.0));
  const auto tiny = load_body(emitter("directional", R"(<vector name="direction" x="-1e-200"/>)"));
  CHECK(tiny.directional_lights.at(0).direction == Vec3(-1, 0, 0));
  CHECK_THAT(error_in(emitter("directional", "<vector name=\"direction\" x=\"0\"/>")),
             StartsWith("scene.xml:3: "));
}

TEST_CASE("Constant and area emitters") {
  const auto scene =
      load_body(emitter("constant", R"(<rgb name="radiance" value=".5"/>)") + "<shape type=\"cube\">" +
                emitter("area", R"(<rgb name="radiance" value="1 2 3"/>)") +
                "</shape><shape type=\"sphere\">" + emitter("area", "") + "</shape>");
  CHECK(scene.constant_radiance == Rgb(0.5));
  REQUIRE(scene.area_emitters.size() == 2);
  CHECK(scene.area_emitters[0].radiance == Rgb(1, 2, 3));
  CHECK(scene.area_emitters[1].radiance == Rgb(1.0));
  for (const auto& face : scene.patches) CHECK(face.surface.area_emitter == 0);
  CHECK(scene.spheres.at(0).surface.area_emitter == 1);
}

TEST_CASE("The power of an area light is its radiance times pi times the area under toWorld") {
  const auto patch = load_body("<shape type=\"rectangle\">" +
                               to_world(R"(<scale x="2" y="3"/><rotate x="1" y="1" angle="33"/>)") +
                               emitter("area", "") + "</shape>")
                         .patches.at(0);
  CHECK(4.0 * glm::length(glm::cross(patch.edge_u, patch.edge_v)) ==
        Approx(4.0 * 6.0)); // the rectangle is [-1, 1]^2
}

TEST_CASE("Emitters that are wrong, or emit nothing") {
  CHECK_THAT(error_in(emitter("point", "<rgb name=\"intensity\" value=\"1 -1 1\"/>")),
             StartsWith("scene.xml:3: ") && Contains("negative emission"));
  CHECK_THAT(
      error_in(emitter("projector", "")),
      StartsWith("scene.xml:2: <emitter type=\"projector\"> is not supported: supported are area, point"));
  for (const char* type : {"sky", "sun", "sunsky"})
    CHECK_THAT(error_in(emitter(type, "")), StartsWith("scene.xml:2: ") && Contains("to an envmap"));
  CHECK_THAT(error_in(emitter("area", "")),
             StartsWith("scene.xml:2: <emitter type=\"area\"> outside a shape"));
  CHECK_THAT(error_in("<shape type=\"disk\">" + emitter("point", "") + "</shape>"),
             StartsWith("scene.xml:2: "));
  CHECK_THAT(error_in(emitter("constant", "") + "\n" + emitter("constant", "")),
             StartsWith("scene.xml:4: a second constant or envmap emitter"));
  const std::string dark =
      "<shape type=\"disk\">" + emitter("area", "<rgb name=\"radiance\" value=\"0\"/>") + "</shape>";
  CHECK(load_body(dark).area_emitters.empty());
  CHECK_THAT(log_of(with_sensor(dark)),
             Contains("emits nothing and is left out") && Contains("warning: scene.xml: no light"));
}

TEST_CASE("An empty scene is rendered, with warnings") {
  CHECK_THAT(log_of(with_sensor("")),
             Contains("warning: scene.xml: empty scene") && Contains("warning: scene.xml: no light"));
}
