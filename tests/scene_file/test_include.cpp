#include <catch2/catch.hpp>

#include "scene_file/load.h"
#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("Included files share ids and parameters, and errors name their lines") {
  const std::string main =
      with_sensor("<default name=\"part\" value=\"b\"/><include filename=\"$part.xml\"/>\n"
                  "<shape type=\"sphere\"><ref id=\"red\"/></shape>");
  const std::string part =
      "<scene version=\"0.6.0\"><default name=\"r\" value=\".7\"/>\n<bsdf type=\"diffuse\" id=\"red\">"
      "<rgb name=\"reflectance\" value=\"$r 0 0\"/></bsdf><shape type=\"disk\"/></scene>";
  const auto scene = load_files({{"scene.xml", main}, {"b.xml", part}}, {{"r", ".25"}});
  REQUIRE(scene.spheres.size() == 1);
  CHECK(scene.patches.size() == 1);
  const auto& material = scene.materials.at(static_cast<std::size_t>(scene.spheres[0].surface.material));
  CHECK(material.value("reflectance") == phlux::scene::Rgb(.25, 0, 0));
  CHECK_THAT(error_of_files({{"scene.xml", main},
                             {"b.xml", "<scene version=\"0.6.0\">\n<shape type=\"torus\"/></scene>"}}),
             Contains("b.xml:2: <shape type=\"torus\"> is not supported") &&
                 Contains("scene.xml:3: reference to 'red'"));
}

TEST_CASE("A default holds from its line on, also one of an included file") {
  const std::string lamp = "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"$rad\"/></emitter>";
  const std::string own = "<default name=\"rad\" value=\"1\"/>", include = "<include filename=\"b.xml\"/>";
  const auto radiance = [&](const std::string& body) {
    return load_files({{"scene.xml", with_sensor(body)},
                       {"b.xml", scene_text("<default name=\"rad\" value=\"3\"/>")}})
        .constant_radiance.value()
        .r;
  };
  CHECK(radiance(include + own + lamp) == 3.0);
  CHECK(radiance(own + include + lamp) == 1.0);
  CHECK_THAT(error_in(lamp + own), StartsWith("scene.xml:2: unknown parameter in '$rad'"));
}

TEST_CASE("An included file is sought beside the one that includes it, and may contain a single object") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "parts");
  folder.write("parts/b.xml", scene_text("<include filename=\"c.xml\"/>"));
  folder.write("parts/c.xml",
               "<shape type=\"sphere\" version=\"3.0.0\"><float name=\"radius\" value=\"2\"/></shape>");
  folder.write("c.xml", "<shape type=\"disk\" version=\"3.0.0\"/>");
  folder.write("scene.xml", with_sensor("<include filename=\"parts/b.xml\"/>", "3.0.0"));
  const auto scene = phlux::scene_file::load(folder / "scene.xml");
  REQUIRE(scene.spheres.size() == 1);
  CHECK(scene.spheres[0].radius == 2.0);
  CHECK(scene.patches.empty());
  CHECK_THAT(error_of("<shape type=\"disk\"/>"), Contains("outermost element must be <scene>"));
}

TEST_CASE("Includes that are missing, circular, endless or malformed are errors") {
  const std::string main = with_sensor("<include filename=\"b.xml\"/>");
  CHECK_THAT(error_of_files({{"scene.xml", main}}),
             StartsWith("scene.xml:2: ") && Contains("b.xml' cannot be read"));
  CHECK_THAT(error_of_files({{"scene.xml", main}, {"b.xml", scene_text("<include filename=\"b.xml\"/>")}}),
             Contains("b.xml:2: ") && Contains("includes itself"));
  CHECK_THAT(
      error_of_files({{"scene.xml", main}, {"b.xml", scene_text("<include filename=\"scene.xml\"/>")}}),
      Contains("b.xml:2: ") && Contains("includes itself"));
  CHECK_THAT(error_of_files({{"scene.xml", main}, {"b.xml", "<scene>\n<"}}),
             StartsWith("b.xml:2: malformed XML"));
  CHECK_THAT(error_in("<include/>"), StartsWith("scene.xml:2: <include> without a filename"));
  Files doubling{{"scene.xml", with_sensor("<include filename=\"f0.xml\"/>")}};
  for (int i = 0; i < 30; ++i) {
    const std::string next = "<include filename=\"f" + std::to_string(i + 1) + ".xml\"/>";
    doubling["f" + std::to_string(i) + ".xml"] = scene_text(next + next);
  }
  doubling["f30.xml"] = scene_text("");
  CHECK_THAT(error_of_files(doubling), Contains("too many files are included: at most 1000"));
}

TEST_CASE("<path> adds a folder; a name with backslashes is found too; <alias> gives a second id") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "parts/deep");
  folder.write("parts/b.xml", scene_text("<shape type=\"sphere\"><ref id=\"second\"/></shape>"));
  folder.write("parts/deep/c.xml", scene_text("<bsdf type=\"diffuse\" id=\"first\"/>"));
  folder.write("scene.xml",
               with_sensor("<path value=\"parts\"/><include filename=\"b.xml\"/>"
                           "<include filename=\"parts\\deep\\c.xml\"/><alias id=\"first\" as=\"second\"/>"));
  CHECK(phlux::scene_file::load(folder / "scene.xml").spheres.size() == 1);
  folder.write("b.xml", scene_text("<shape type=\"disk\"><ref id=\"second\"/></shape>"));
  folder.write("text.xml", with_sensor("<path value=\"parts\"/><include filename=\"deep/c.xml\"/>"));
  CHECK_NOTHROW(phlux::scene_file::load(folder / "text.xml")); // before the scene's own folder
  CHECK_THAT(error_in("<path value=\"none\"/>"), StartsWith("scene.xml:2: <path>: 'none' is no folder"));
  CHECK_THAT(error_in("<alias id=\"none\" as=\"b\"/>"), StartsWith("scene.xml:2: reference to 'none'"));
}

TEST_CASE("Area emitters by reference, True and False of Mitsuba 3") {
  const auto scene = load_body(R"(<emitter type="area" id="lamp"><rgb name="radiance" value="3"/></emitter>
    <shape type="sphere"><ref id="lamp"/><boolean name="flip_normals" value="True"/></shape>
    <shape type="disk"><ref id="lamp"/><boolean name="flip_normals" value="False"/></shape>)",
                               "3.0.0");
  REQUIRE(scene.area_emitters.size() == 2);
  CHECK(scene.area_emitters[1].radiance == phlux::scene::Rgb(3.0));
  CHECK(scene.spheres.at(0).front_is_inside);
  CHECK_THAT(error_in("<emitter type=\"area\" id=\"lamp\"/>"), Contains("outside a shape"));
}

TEST_CASE("A folder that many <path>s name is sought in once; there are at most a thousand") {
  const TemporaryFolder folder;
  std::string body;
  for (int i = 0; i < 1001; ++i) {
    const std::string name = (folder / std::to_string(i)).string();
    std::filesystem::create_directory(name);
    body += "<path value=\"" + name + "\"/>\n";
  }
  CHECK_THAT(error_in(body), StartsWith("scene.xml:1002: more than 1000 folders by <path>: fewer folders"));
  std::string same;
  for (int i = 0; i < 3000; ++i)
    same += "<path value=\"" + (folder / std::to_string(i % 2)).string() + "\"/>\n";
  CHECK(error_in(same).empty());
}
