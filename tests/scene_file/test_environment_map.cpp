// <emitter type="envmap">
#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include "errors.h"
#include "scene_file/images.h"
#include "scene_file/load.h"
#include "scene_file/scenes.h"

using namespace phlux;
using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using scene::Rgb;
using scene::Vec3;

namespace {

std::string envmap(const std::string& file, const std::string& more = "") {
  return "<emitter type=\"envmap\">\n<string name=\"filename\" value=\"" + file + "\"/>\n" + more +
         "</emitter>\n";
}

scene::Scene load_beside(const std::string& name, const std::string& bytes, const std::string& body) {
  const TemporaryFolder folder;
  folder.write(name, bytes);
  folder.write("scene.xml", with_sensor(body + "<shape type=\"sphere\"/>"));
  return scene_file::load(folder / "scene.xml");
}

std::string error_beside(const std::string& name, const std::string& bytes, const std::string& body) {
  const TemporaryFolder folder;
  folder.write(name, bytes);
  folder.write("scene.xml", with_sensor(body));
  try {
    static_cast<void>(scene_file::load(folder / "scene.xml"));
  } catch (const SceneError& error) {
    return without_folder(error.what(), folder);
  }
  return "";
}

} // namespace

TEST_CASE("Environment maps: texels, scale and orientation") {
  const auto map =
      load_beside("sky.hdr", hdr(),
                  envmap("sky.hdr", "<float name=\"scale\" value=\"3\"/><transform name=\"toWorld\">"
                                    "<scale value=\"2\"/><rotate x=\"1\" angle=\"90\"/>"
                                    "<translate x=\"5\"/></transform>"))
          .environment;
  REQUIRE(map);
  CHECK(map->width == 1);
  CHECK(map->height == 1);
  CHECK(map->texels == std::vector{glm::vec3(0.5F, 0.25F, 8)});
  CHECK(map->scale == Rgb(3));
  CHECK(glm::length(map->to_world * Vec3(0, 1, 0) - Vec3(0, 0, 1)) < 1e-12);
  const auto exr_map =
      load_beside("sky.exr", exr("BGR", {0.25F, 3, 0, 1, 5, 6}, 3), envmap("sky.exr")).environment;
  REQUIRE(exr_map);
  CHECK(exr_map->width == 3);
  CHECK(exr_map->texels[4] == glm::vec3(5));
  const auto encoded = load_beside("sky.png", png(), envmap("sky.png")).environment; // sRGB
  REQUIRE(encoded);
  CHECK(encoded->texels[0] == glm::vec3(1, 0, 0));
  CHECK(encoded->texels[1].g == Approx(0.2158605F));
  CHECK(encoded->texels[3].r == Approx(10.0F / 255 / 12.92F));
}

TEST_CASE("Environment maps that are wrong, or emit nothing") {
  CHECK_THAT(error_in("<emitter type=\"envmap\"/>"),
             StartsWith("scene.xml:2: ") && Contains("without a filename"));
  CHECK_THAT(error_in(envmap("none.exr")), StartsWith("scene.xml:3: image file 'none.exr' cannot be read"));
  const std::string good = hdr();
  CHECK_THAT(error_beside("sky.hdr", good.substr(0, good.size() - 1), envmap("sky.hdr")),
             StartsWith("scene.xml:3: image file 'sky.hdr': ") && Contains("cut short"));
  CHECK_THAT(
      error_beside("sky.exr", exr("Y", {1, 2, 3, -0.5F}, 2), envmap("sky.exr")),
      StartsWith("scene.xml:3: image file 'sky.exr': pixel (1, 1) is negative: radiance is 0 or more"));
  const auto properties = [&](const std::string& more) {
    return error_beside("sky.hdr", good, envmap("sky.hdr", more));
  };
  CHECK_THAT(properties("<float name=\"scale\" value=\"-1\"/>"),
             StartsWith("scene.xml:4: ") && Contains("negative"));
  CHECK_THAT(properties("<transform name=\"toWorld\"><scale x=\"2\"/></transform>"),
             StartsWith("scene.xml:4: ") && Contains("it shears or stretches"));
  CHECK_THAT(properties("</emitter><emitter type=\"constant\">"),
             Contains("a second constant or envmap emitter"));
  CHECK_FALSE(load_beside("sky.exr", exr("Y", {0, 0}, 2), envmap("sky.exr")).environment);
  CHECK_FALSE(
      load_beside("sky.hdr", good, envmap("sky.hdr", "<float name=\"scale\" value=\"0\"/>")).environment);
}
