#include <catch2/catch.hpp>

#include <filesystem>
#include <sys/stat.h>

#include "errors.h"
#include "printable.h"
#include "scene_file/load.h"
#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("$name takes the definition, else the default, and holds in every attribute") {
  const std::string text = scene_text(R"(<default name="w" value="10"/><default name="wide" value="20"/>
    <sensor type="$kind"><film type="hdrfilm"><integer name="width" value="$wide"/>
      <integer name="height" value="$w$w"/></film></sensor>)");
  const auto scene = load_text(text, {{"kind", "perspective"}, {"w", "3"}});
  CHECK(scene.camera.width == 20);  // the longest name that fits
  CHECK(scene.camera.height == 33); // -D goes before <default>
}

TEST_CASE("Parameters that are unknown or unused are errors") {
  CHECK_THAT(
      error_of(with_sensor("<emitter type=\"constant\"><float name=\"radiance\" value=\"$L\"/></emitter>")),
      StartsWith("scene.xml:2: unknown parameter in '$L'"));
  CHECK_THAT(error_of(with_sensor(""), {{"spp", "3"}}), StartsWith("scene.xml: `D` spp=3 is used nowhere"));
  CHECK_THAT(error_of(with_sensor("<default name=\"spp\"/>")), StartsWith("scene.xml:2: <default> without"));
}

TEST_CASE("XML that is malformed or not a scene is an error at its line") {
  CHECK_THAT(error_of("<scene version=\"0.6.0\">\n<bsdf type=\"diffuse\">\n</scene>\n"),
             StartsWith("scene.xml:3: malformed XML"));
  CHECK_THAT(error_of("\n<mesh/>\n"), StartsWith("scene.xml:2: the file's only outermost element"));
  CHECK_THAT(error_of(""), StartsWith("scene.xml:1: malformed XML"));
  CHECK_THAT(error_of(with_sensor("hello")),
             StartsWith("scene.xml:1: text inside <scene>")); // its start: line 1's end
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<bsdf type=\"twosided\">";
  for (int i = 0; i < 100000; ++i) deep += "</bsdf>";
  CHECK_THAT(error_in(deep), StartsWith("scene.xml:2: elements are nested too deeply"));
}

TEST_CASE("Versions 0.4 to 0.6, 2 and 3 are read") {
  for (const char* version : {"0.4.0", "0.5.0", "0.6.0", "2.1.0", "3.0.0", "3.5.2"})
    CHECK(error_in("", version).empty());
  for (const char* version : {"0.3.0", "0.7.0", "1.0", "4.0", "", "x", "0"})
    CHECK_THAT(error_in("", version),
               StartsWith("scene.xml:1: ") && Contains("versions 0.4, 0.5, 0.6, 2.x and 3.x"));
  CHECK_THAT(error_of("<scene/>"), StartsWith("scene.xml:1: the scene states no version"));
}

TEST_CASE("Unknown elements and attributes are errors that name what is supported") {
  CHECK_THAT(error_in("\n<world/>"),
             StartsWith("scene.xml:3: element <world> is not supported: supported are "
                        "alias, blackbody, boolean, bsdf,"));
  CHECK_THAT(error_in("\n<medium type=\"homogeneous\"/>"),
             StartsWith("scene.xml:3: <medium type=\"homogeneous\"> inside <scene> is not supported"));
  CHECK_THAT(error_in("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" vlaue=\"1\"/></bsdf>"),
             StartsWith("scene.xml:2: attribute 'vlaue' of <rgb> is not supported"));
  CHECK_THAT(
      error_in("<bsdf type=\"diffuse\">\n<medium type=\"homogeneous\"/></bsdf>"),
      StartsWith(
          "scene.xml:3: <medium type=\"homogeneous\"> inside <bsdf type=\"diffuse\"> is not supported"));
  CHECK_THAT(error_in("<bsdf type=\"phong\">\n<shape type=\"disk\"/></bsdf>"),
             StartsWith("scene.xml:3: <shape type=\"disk\"> inside <bsdf type=\"phong\"> is not supported"));
  CHECK_THAT(error_in("<float name=\"a\" value=\"1\"><rgb name=\"b\" value=\"1\"/></float>"),
             StartsWith("scene.xml:2: element inside <float>"));
  CHECK_THAT(error_of("<scene version=\"0.6.0\">\n</scene>"),
             StartsWith("scene.xml:1: the scene has no camera"));
  CHECK_THAT(error_in("<sensor type=\"perspective\"/>"),
             StartsWith("scene.xml:2: <scene> has more than one <sensor>"));
}

TEST_CASE("Names of properties: misspelt, missing, double") {
  CHECK_THAT(error_in("<bsdf type=\"phong\">\n<float name=\"exponnent\" value=\"3\"/></bsdf>"),
             StartsWith("scene.xml:3: 'exponnent' is not a property of <bsdf type=\"phong\">: supported are "
                        "diffuseReflectance, ensureEnergyConservation, exponent, specularReflectance"));
  CHECK_THAT(error_in("<bsdf type=\"phong\">\n<float name=\"exponnent\" value=\"3\"/></bsdf>", "3.0.0"),
             Contains("supported are diffuse_reflectance,"));
  CHECK_THAT(error_in("<bsdf type=\"phong\">\n<float value=\"3\"/></bsdf>"),
             StartsWith("scene.xml:3: <float> without a name"));
  CHECK_THAT(
      error_in(
          "<shape type=\"disk\">\n<transform name=\"toWorld\"/>\n<transform name=\"to_world\"/></shape>"),
      StartsWith("scene.xml:4: 'to_world' is given twice: the first is on line 3"));
}

TEST_CASE("References: backward, forward, to nothing, to themselves, ids used twice") {
  CHECK(error_in("<bsdf type=\"diffuse\" id=\"a\"/><shape type=\"disk\"><ref id=\"a\"/></shape>").empty());
  CHECK(error_in("<shape type=\"disk\"><ref id=\"a\"/></shape><bsdf type=\"diffuse\" id=\"a\"/>").empty());
  CHECK_THAT(error_in("<bsdf type=\"diffuse\" id=\"a\"/><shape type=\"disk\">\n<ref id=\"b\"/></shape>"),
             StartsWith("scene.xml:3: reference to 'b', which is not in the file: the ids are a"));
  CHECK_THAT(error_in("<bsdf type=\"twosided\" id=\"a\">\n<ref id=\"a\"/></bsdf>"),
             StartsWith("scene.xml:3: reference to 'a' is circular"));
  CHECK_THAT(error_in("<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n"
                      "<bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>"),
             StartsWith("scene.xml:3: reference to 'a' is circular"));
  CHECK_THAT(error_in("<bsdf type=\"diffuse\" id=\"a\"/>\n<shape type=\"disk\" id=\"a\"/>"),
             StartsWith("scene.xml:3: id 'a' is used twice: the first is on line 2"));
  CHECK_THAT(error_in("<shape type=\"disk\" id=\"d\"/>\n<shape type=\"disk\">\n<ref id=\"d\"/></shape>"),
             StartsWith("scene.xml:4: <shape type=\"disk\"> inside <shape type=\"disk\"> is not supported"));
}

TEST_CASE("Values: numbers, booleans, types") {
  const auto with_exponent = [](const std::string& value) {
    return error_in("<bsdf type=\"phong\">\n<float name=\"exponent\" value=\"" + value + "\"/></bsdf>");
  };
  for (const char* good : {"3", "+3", " 3e1 ", ".5", "5.", "1E+2"}) CHECK(with_exponent(good).empty());
  for (const char* bad :
       {"", "3,5", "3 4", "0x10", "3f", "nan", "inf", "1e39", "1e999", "+-3", "--3", "three"})
    CHECK_THAT(with_exponent(bad), StartsWith("scene.xml:3: <bsdf type=\"phong\">: exponent: '" +
                                              std::string(bad) + "' is not a number"));
  CHECK_THAT(error_in("<bsdf type=\"phong\">\n<string name=\"exponent\" value=\"3\"/></bsdf>"),
             StartsWith("scene.xml:3: 'exponent' is a <string>: it must be one of <float>, <integer>"));
  CHECK_THAT(error_in("<shape type=\"disk\">\n<boolean name=\"flipNormals\" value=\"yes\"/></shape>"),
             StartsWith("scene.xml:3: <shape type=\"disk\">: flipNormals: 'yes' is not a boolean"));
  CHECK_THAT(error_in("<integrator type=\"path\">\n<integer name=\"maxDepth\" value=\"5.0\"/></integrator>"),
             StartsWith("scene.xml:3: <integrator type=\"path\">: maxDepth: '5.0' is not an integer"));
  // As in Mitsuba, 2 and later ignore case.
  const std::string in_python =
      "<shape type=\"disk\"><boolean name=\"flip_normals\" value=\"True\"/></shape>";
  CHECK(load_body(in_python, "3.0.0").patches.front().edge_v.y == -1.0);
  CHECK_THAT(error_in(in_python), Contains("'True' is not a boolean"));
  CHECK(with_exponent("1e-400").empty());
}

TEST_CASE("Small files that would take all memory or time are refused") {
  std::string laughs = "<default name=\"a0\" value=\"ha\"/>";
  for (int i = 1; i < 20; ++i) {
    const std::string before = "$a" + std::to_string(i - 1) + " ";
    laughs +=
        "<default name=\"a" + std::to_string(i) + "\" value=\"" + before + before + before + before + "\"/>";
  }
  CHECK_THAT(error_in(laughs), StartsWith("scene.xml:2: ") && Contains("is longer than 1000000 characters"));
  std::string wide = "<default name=\"a\" value=\"" + std::string(900'000, '1') + "\"/>";
  for (int i = 0; i < 100; ++i) wide += "<bsdf type=\"$a\"/>";
  CHECK_THAT(error_in(wide), Contains("more than 64000000 characters are substituted"));
  CHECK_THAT(error_in("<default name=\"" + std::string(300, 'a') + "\" value=\"\"/>"),
             StartsWith("scene.xml:2: a <default> with a name of 300 characters"));
  std::string chain;
  for (int i = 0; i < 100'000; ++i)
    chain += "<bsdf type=\"twosided\" id=\"" + std::to_string(i) + "\"><ref id=\"" + std::to_string(i + 1) +
             "\"/></bsdf>";
  CHECK_THAT(error_in(chain + "<bsdf type=\"diffuse\" id=\"100000\"/>"),
             StartsWith("scene.xml:2: references are nested too deeply"));
  CHECK(error_in("<bsdf type=\"" + std::string(100'000, 'x') + "\"/>").size() < 3000); // of one line
}

TEST_CASE("Messages contain nothing that controls a terminal") {
  CHECK(phlux::printable("a\x1b[31m\x7f\n\xc2\x9b\xe2\x80\xae!") == "a?[31m???"
                                                                    "?!");
  CHECK(phlux::printable("Gr\xc3\xbc\xc3\x9f\x65 \xe2\x82\xac \xf0\x9f\x99\x82") ==
        "Gr\xc3\xbc\xc3\x9f\x65 \xe2\x82\xac \xf0\x9f\x99\x82");
  CHECK(phlux::printable("\xff\xc3(\xc0\x80\xed\xa0\x80\xe2\x82") == "?"
                                                                     "?("
                                                                     "???????"); // not UTF-8
  CHECK(phlux::printable("a\n\tb\r", true) == "a\n\tb?");
}

TEST_CASE("A device or a pipe in the place of a file is refused at once") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  std::filesystem::create_symlink("loop", folder / "loop");
  for (const std::filesystem::path& file :
       {folder / "pipe", folder / "loop", std::filesystem::path("/dev/zero")})
    CHECK_THROWS_WITH(phlux::scene_file::load(file), Contains(": cannot be read: "));
}

TEST_CASE("A file that is missing or a folder is an error") {
  const TemporaryFolder folder;
  for (const auto& file : {folder / "absent.xml", folder.path()})
    CHECK_THROWS_MATCHES(
        phlux::scene_file::load(file), phlux::SceneError,
        Catch::Message(file.string() + ": cannot be read: an existing Mitsuba scene file is needed"));
}

TEST_CASE("A scene cut short anywhere is a scene or a SceneError, and so is one with a byte changed") {
  const std::string text = TemporaryFolder::read(PHLUX_SOURCE_DIR "/scenes/two-phong-spheres.xml");
  for (std::size_t size = 0; size < text.size(); size += 7) {
    CHECK_NOTHROW(error_of(text.substr(0, size))); // error_of lets anything but a SceneError through
    std::string changed = text;
    changed[size] = "<>\"$ 0&-"[size % 8];
    CHECK_NOTHROW(error_of(changed));
  }
}
