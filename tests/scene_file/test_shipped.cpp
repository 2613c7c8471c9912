#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <glm/gtx/component_wise.hpp>

#include "materials.h"
#include "scene_file/load.h"

using phlux::scene_file::load;

namespace {

const std::filesystem::path scenes = PHLUX_SOURCE_DIR "/scenes";

std::set<std::string> shipped() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scenes))
    if (entry.path().extension() == ".xml") names.insert(entry.path().stem());
  return names;
}

} // namespace

TEST_CASE("Every shipped scene loads, has a camera and light, and takes width, height and spp") {
  const auto names = shipped();
  for (const char* name : {"cornell-box", "glossy-box", "caustic", "furnace-box", "furnace-sphere",
                           "point-light", "mesh", "two-phong-spheres"})
    CHECK(names.contains(name));
  for (const auto& name : names) {
    INFO(name);
    const auto scene = load(scenes / (name + ".xml"), {{"width", "7"}, {"height", "5"}, {"spp", "3"}});
    CHECK(scene.camera.width == 7);
    CHECK(scene.camera.height == 5);
    CHECK(scene.defaults.samples_per_pixel == 3);
    CHECK(scene.area_emitters.size() + scene.point_lights.size() + (scene.constant_radiance ? 1 : 0) > 0);
  }
}

TEST_CASE("Every shipped scene is in scenes/README.md") {
  std::ifstream stream(scenes / "README.md");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  for (const auto& name : shipped()) CHECK_THAT(text, Catch::Contains("[" + name + ".xml]"));
}

TEST_CASE("Every scene of scenes/stability loads, takes width, height and spp, and is in its README") {
  std::ifstream stream(scenes / "stability" / "README.md");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  for (const auto& entry : std::filesystem::directory_iterator(scenes / "stability")) {
    if (entry.path().extension() != ".xml") continue;
    INFO(entry.path());
    CHECK_THAT(text, Catch::Contains("[" + entry.path().filename().string() + "]"));
    if (entry.path().stem() == "million-lights") continue; // a script generates its mesh
    const auto scene = load(entry.path(), {{"width", "7"}, {"height", "5"}, {"spp", "3"}});
    CHECK(scene.camera.width == 7);
    CHECK(scene.camera.height == 5);
    CHECK(scene.defaults.samples_per_pixel == 3);
  }
}

TEST_CASE("The shipped mesh has 20,000 triangles or more, whose normals and windings agree") {
  const auto mesh = load(scenes / "mesh.xml").meshes.at(0);
  CHECK(mesh.triangles.size() >= 20000);
  CHECK(mesh.normals.size() == mesh.positions.size());
  double volume = 0.0; // positive if the front is outside
  for (const auto& t : mesh.triangles)
    volume += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6.0;
  CHECK(volume > 0.1);
}

TEST_CASE("The furnaces are what their closed forms need") {
  const auto box = load(scenes / "furnace-box.xml");
  REQUIRE(box.patches.size() == 6);
  CHECK(box.materials.size() == 1);
  CHECK(phlux::test::diffuse_of(box.materials[0]) == phlux::scene::Rgb(0.5));
  CHECK(box.area_emitters.at(0).radiance == phlux::scene::Rgb(1.0));
  for (const auto& wall : box.patches) { // the camera sees the front of each
    const auto normal = glm::cross(wall.edge_u, wall.edge_v);
    CHECK(glm::dot(normal, box.camera.position - wall.origin) > 0.0);
  }
  const auto sphere = load(scenes / "furnace-sphere.xml");
  CHECK(sphere.spheres.size() == 1);
  CHECK(sphere.patches.empty());
  CHECK(sphere.constant_radiance == phlux::scene::Rgb(1.0));
}
