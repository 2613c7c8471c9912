// The generator of random scenes: what it makes is valid, repeatable, and all that scene files may say.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <spdlog/spdlog.h>

#include "random/random_scene.h"

using namespace phlux;
using namespace phlux::test;

TEST_CASE("random scenes are the same each time, and differ by family and member", "[second]") {
  CHECK(random_scene({3, 1}).xml == random_scene({3, 1}).xml);
  CHECK(random_scene({3, 1}).xml != random_scene({3, 2}).xml);
  CHECK(random_scene({3, 1}).xml != random_scene({4, 1}).xml);
}

TEST_CASE("random scenes can be loaded, and together say all that a scene file may say", "[second]") {
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::err);
  std::string all;
  for (std::uint64_t family = 0; family < 100; ++family) {
    const SceneNumber number{family, family % 3};
    CAPTURE(name_of(number));
    CHECK_NOTHROW(load_random_scene(number));
    const RandomScene scene = random_scene(number);
    all += scene.xml;
    for (const auto& [name, bytes] : scene.meshes) all += bytes.substr(0, bytes.find("end_header"));
  }
  spdlog::set_level(level);
  for (const char* part : {"version=\"0.5",
                           "version=\"0.6",
                           "version=\"2",
                           "version=\"3",
                           "<default",
                           "value=\"$",
                           "<ref",
                           "type=\"path\"",
                           "type=\"ptracer\"",
                           "type=\"bdpt\"",
                           "\"maxDepth\"",
                           "\"max_depth\"",
                           "\"rrDepth\"",
                           "\"fovAxis\"",
                           "\"diagonal\"",
                           "\"principalPointOffsetX\"",
                           "<lookat",
                           "<lookAt",
                           "<matrix",
                           "<rotate",
                           "<scale value",
                           "<scale x",
                           "<translate x",
                           "<translate value",
                           "<spectrum",
                           "<rgb",
                           "type=\"diffuse\"",
                           "type=\"phong\"",
                           "\"exponentU\"",
                           "\"exponent_v\"",
                           "type=\"twosided\"",
                           "\"ensureEnergyConservation\"",
                           "type=\"rectangle\"",
                           "type=\"cube\"",
                           "type=\"disk\"",
                           "type=\"sphere\"",
                           "type=\"obj\"",
                           "type=\"ply\"",
                           "\"center\"",
                           "\"radius\"",
                           "\"flipNormals\"",
                           "\"faceNormals\"",
                           "type=\"area\"",
                           "type=\"point\"",
                           "type=\"spot\"",
                           "\"beamWidth\"",
                           "type=\"directional\"",
                           "type=\"constant\"",
                           "format ascii",
                           "binary_little",
                           "binary_big",
                           "property float nx",
                           "vn ",
                           "\"exponent\" value=\"0\"",
                           "\"exponent\" value=\"1000000\""}) {
    CAPTURE(part);
    CHECK(all.find(part) != std::string::npos);
  }
}
