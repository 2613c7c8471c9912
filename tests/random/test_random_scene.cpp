// The generator of random scenes: its scenes are valid, reproducible, and cover everything that scene files
// may contain.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <spdlog/spdlog.h>

#include "random/methods.h"
#include "random/random_scene.h"
#include "random/twin.h"
#include "scene_file/load.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;

TEST_CASE("random scenes are the same each time, and differ by family and member", "[second]") {
  CHECK(random_scene({3, 1}).xml == random_scene({3, 1}).xml);
  CHECK(random_scene({3, 1}).xml != random_scene({3, 2}).xml);
  CHECK(random_scene({3, 1}).xml != random_scene({4, 1}).xml);
}

TEST_CASE("random scenes can be loaded, and together cover everything that a scene file may contain",
          "[second]") {
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::err);
  std::string all;
  for (std::uint64_t family = 0; family < 100; ++family) {
    const SceneNumber number{family, family % 3};
    CAPTURE(name_of(number));
    CHECK_NOTHROW(load_random_scene(number));
    const RandomScene scene = random_scene(number);
    all += scene.xml;
    for (const auto& [name, bytes] : scene.files) all += bytes.substr(0, bytes.find("end_header"));
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
                           "type=\"conductor\"",
                           "type=\"dielectric\"",
                           "type=\"thindielectric\"",
                           "type=\"plastic\"",
                           "type=\"roughconductor\"",
                           "type=\"roughdielectric\"",
                           "type=\"roughplastic\"",
                           "\"exponentU\"",
                           "\"exponent_v\"",
                           "type=\"twosided\"",
                           "type=\"mask\"",
                           "type=\"bitmap\"",
                           "type=\"checkerboard\"",
                           ".tga\"",
                           "name=\"opacity\"",
                           "\"alphaV\"",
                           "\"hideEmitters\"",
                           "\"ensureEnergyConservation\"",
                           "type=\"rectangle\"",
                           "type=\"cube\"",
                           "type=\"disk\"",
                           "type=\"sphere\"",
                           "type=\"obj\"",
                           "type=\"ply\"",
                           "type=\"shapegroup\"",
                           "type=\"instance\"",
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
                           "type=\"envmap\"",
                           "type=\"thinlens\"",
                           "type=\"orthographic\"",
                           "rfilter type=\"tent\"",
                           "rfilter type=\"gaussian\"",
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

TEST_CASE("random scenes: twins have blunt lobes and large lamps, and are else the same", "[second]") {
  int twins = 0;
  for (std::uint64_t family = 0; family < 10; ++family) {
    const SceneNumber number{family, 0};
    const std::vector<render::Settings> methods = methods_of_family(family, 4);
    const std::optional<Twin> twin = twin_of(number, methods);
    const scene::Scene original = load_random_scene(number), other = load_random_scene(number, twin);
    const SceneFacts facts = facts_of(other);
    CAPTURE(name_of(number));
    for (const render::Settings& method : methods) {
      CAPTURE(name_of(method));
      CHECK(doubts(for_scene(method, other, facts), facts).empty());
    }
    REQUIRE(original.materials.size() == other.materials.size());
    for (std::size_t i = 0; i < original.materials.size(); ++i) {
      const scene::Material &a = original.materials[i], &b = other.materials[i];
      REQUIRE(a.model == b.model);
      for (std::size_t k = 0; k < a.values.size(); ++k) {
        const bool is_exponent = a.model->parameters[k].name.starts_with("exponent");
        const double most = twin && is_exponent ? twin->most_exponent : INFINITY;
        CHECK(b.values[k] == glm::min(a.values[k], scene::Rgb(most)));
      }
    }
    twins += twin ? 1 : 0;
  }
  CHECK(twins > 0);
  CHECK(twins < 10);
}

TEST_CASE("random scenes: facts of views and lights", "[second]") {
  const auto facts = [](const char* shape, double distance) {
    const std::string xml = fmt::format(
        "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"90\"/>"
        "<film type=\"hdrfilm\"><integer name=\"width\" value=\"5\"/><integer name=\"height\" value=\"5\"/>"
        "</film></sensor><emitter type=\"point\"><point name=\"position\" value=\"0, 0, 0\"/></emitter>"
        "<shape type=\"sphere\"><float name=\"radius\" value=\"100\"/></shape>"
        "<shape type=\"{}\"><transform name=\"to_world\"><rotate y=\"1\" angle=\"180\"/><translate z=\"{}\"/>"
        "</transform></shape></scene>",
        shape, distance);
    const TemporaryFolder folder;
    return facts_of(scene_file::load(write_scene({xml, {}}, folder.path(), "facts")));
  };
  // Everything is within a box of half edge 100. The area of the film is 4 at the distance 1.
  const double nearness = 3 / (100 * std::sqrt(3));
  for (const char* shape : {"rectangle", "disk", "cube", "sphere"}) {
    CAPTURE(shape);
    const bool thick = shape == std::string("cube") || shape == std::string("sphere");
    const SceneFacts found = facts(shape, thick ? 4 : 3);
    CHECK(found.narrowest_view == Approx(4 / (4 * std::numbers::pi) * nearness * nearness).epsilon(1e-3));
    CHECK(found.in_small_spots > 0.01);
    if (shape == std::string("rectangle")) // its solid angle / (4 pi)
      CHECK(found.in_small_spots ==
            Approx(std::atan(1 / (3 * std::sqrt(11.0))) / std::numbers::pi).epsilon(0.1));
  }
}
