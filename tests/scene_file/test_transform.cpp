#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Vec3;

namespace {

std::string rectangle(const std::string& steps, const std::string& name = "toWorld") {
  return "<shape type=\"rectangle\"><transform name=\"" + name + "\">\n" + steps + "</transform></shape>";
}

bool near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) < 1e-12;
}

/// Image of the point (x, y, 0) of the rectangle.
Vec3 image(const std::string& steps, double x, double y, const std::string& version = "0.6.0") {
  const auto patch = load_body(rectangle(steps), version).patches.at(0);
  return patch.origin + x * patch.edge_u + y * patch.edge_v;
}

} // namespace

TEST_CASE("Steps are applied in the order in which they are written") {
  CHECK(near(image(R"(<scale value="2"/><translate x="1"/>)", 1, 1), {3, 2, 0}));
  CHECK(near(image(R"(<translate x="1"/><scale value="2"/>)", 1, 1), {4, 2, 0}));
  CHECK(near(image(R"(<rotate z="1" angle="90"/><translate y="5"/>)", 1, 0), {0, 6, 0}));
  CHECK(near(image(R"(<translate y="5"/><rotate z="1" angle="90"/>)", 1, 0), {-5, 1, 0}));
}

TEST_CASE("Each step") {
  CHECK(near(image(R"(<translate x="1" z="-2"/>)", 0, 0), {1, 0, -2}));
  CHECK(near(image(R"(<translate value="1, 2 3"/>)", 0, 0, "3.0.0"), {1, 2, 3}));
  CHECK(near(image(R"(<translate value="2"/>)", 0, 0, "3.0.0"), {2, 2, 2}));
  CHECK(near(image(R"(<scale y="3"/>)", 1, 1), {1, 3, 0}));
  CHECK(near(image(R"(<scale value="2, 3, 4"/>)", 1, 1, "3.0.0"), {2, 3, 0}));
  CHECK(near(image(R"(<rotate x="2" angle="90"/>)", 0, 1), {0, 0, 1})); // the axis is normalized
  CHECK(near(image(R"(<rotate value="0, 1, 0" angle="90"/>)", 1, 0, "3.0.0"), {0, 0, -1}));
  CHECK(near(image(R"(<matrix value="0 -1 0 5  1 0 0 6  0 0 1 7  0 0 0 1"/>)", 1, 0), {5, 7, 7})); // rows
  CHECK(near(image(R"(<matrix value="0 -1 0 1 0 0 0 0 1"/>)", 1, 0, "3.0.0"), {0, 1, 0}));
  for (const char* tag : {"lookat", "lookAt"}) { // +z to the target, +x to the left
    const std::string step = "<" + std::string(tag) + R"( origin="1, 2, 3" target="1, 2, 9" up="0, 1, 0"/>)";
    CHECK(near(image(step, 0, 0), {1, 2, 3}));
    CHECK(near(image(step, 1, 0), {2, 2, 3}));
    CHECK(near(image(step, 0, 1), {1, 3, 3}));
  }
}

// The directions of `up` are Mitsuba's: its s of 3 (Duff et al.) and of 0.6.
TEST_CASE("lookat without up") {
  const std::string step = R"(<lookat origin="0 0 0" target="1 2 2"/>)";
  const Vec3 forward = Vec3(1, 2, 2) / 3.0;
  for (const auto& [version, up] :
       {std::pair("3.0.0", Vec3(14, -2, -5) / 15.0), {"0.6.0", Vec3(8, -2, -2) / std::sqrt(72.0)}}) {
    CHECK(near(image(step, 0, 1, version), up));
    CHECK(near(image(step, 1, 0, version), glm::cross(up, forward)));
  }
}

TEST_CASE("Both spellings of the name") {
  CHECK(near(load_body(rectangle("<translate x=\"4\"/>", "to_world"), "3.0.0").patches.at(0).origin,
             {4, 0, 0}));
  CHECK(
      near(load_body(rectangle("<translate x=\"4\"/>", "toWorld"), "0.5.0").patches.at(0).origin, {4, 0, 0}));
}

TEST_CASE("Broken transforms are errors at their line") {
  const auto error = [](const std::string& step) { return error_in(rectangle(step)); };
  CHECK_THAT(error("<scale x=\"0\"/>"),
             StartsWith("scene.xml:2: the transform is singular")); // <transform>'s line
  CHECK_THAT(error("<matrix value=\"1 2 3 0 2 4 6 0 0 0 1 0 0 0 0 1\"/>"),
             StartsWith("scene.xml:2: the transform is singular"));
  CHECK_THAT(error("<matrix value=\"1 0 0 0  0 nan 0 0  0 0 1 0  0 0 0 1\"/>"),
             StartsWith("scene.xml:3: <matrix>"));
  CHECK_THAT(error("<matrix value=\"1 0 0 0  0 1 0 0  0 0 1 0  0 0 1 1\"/>"),
             StartsWith("scene.xml:3: <matrix> is projective"));
  CHECK_THAT(error("<matrix value=\"1 2 3\"/>"),
             StartsWith("scene.xml:3: <matrix>") && Contains("16 finite numbers"));
  CHECK_THAT(error("<rotate angle=\"3\"/>"),
             StartsWith("scene.xml:3: <rotate> without an axis: such as <rotate y=\"1\" angle=\"90\"/>"));
  CHECK_THAT(error("<rotate x=\"0\" angle=\"3\"/>"), StartsWith("scene.xml:3: <rotate> without an axis"));
  CHECK_THAT(error("<rotate x=\"1\"/>"), StartsWith("scene.xml:3: <rotate> without an angle"));
  CHECK_THAT(error("<scale/>"), StartsWith("scene.xml:3: <scale> needs either"));
  CHECK_THAT(error("<scale x=\"1\" value=\"2\"/>"), StartsWith("scene.xml:3: <scale> needs either"));
  CHECK_THAT(error("<translate x=\"one\"/>"),
             StartsWith("scene.xml:3: <translate>: x 'one' is not a number"));
  CHECK_THAT(error("<translate value=\"1 2\"/>"), StartsWith("scene.xml:3: <translate>: value '1 2'"));
  CHECK_THAT(error("<lookat origin=\"0 0 0\" target=\"0 0 0\"/>"),
             StartsWith("scene.xml:3: <lookat>: origin and target"));
  CHECK_THAT(error("<lookat origin=\"0 0 0\" target=\"0 0 2\" up=\"0 0 1\"/>"),
             StartsWith("scene.xml:3: <lookat>: up is along"));
  CHECK_THAT(error("<lookat origin=\"0 0\" target=\"0 0 2\"/>"),
             StartsWith("scene.xml:3: <lookat>: origin '0 0'"));
  CHECK_THAT(error("<scale value=\"1e30\"/><scale value=\"1e30\"/>"),
             StartsWith("scene.xml:2: the transform overflows"));
  CHECK_THAT(error("<rgb name=\"a\" value=\"1\"/>"), StartsWith("scene.xml:3: <rgb> inside <transform>"));
}
