#include <catch2/catch.hpp>

#include <algorithm>

#include "scene_file/images.h"
#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;

namespace {

std::ptrdiff_t lines_with(const std::string& text, const std::string& part) {
  std::ptrdiff_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

} // namespace

TEST_CASE("Meshes with zero-area triangles are one warning with the sum, and a note for each other") {
  Files files;
  std::string body;
  for (const std::string name : {"a.obj", "b.obj", "c.obj"}) {
    files[name] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nf 2 2 3\nf 1 2\n";
    body += "<shape type=\"obj\"><string name=\"filename\" value=\"" + name + "\"/></shape>\n";
  }
  files["scene.xml"] = with_sensor(body + body); // each file twice
  const std::string log = log_of_files(files);
  CHECK_THAT(log, Contains("warning: a.obj: 12 zero-area triangles are dropped (the first of 3 places)\n"));
  CHECK_THAT(log, Contains("warning: a.obj: 6 faces with fewer than three corners are dropped (the first of "
                           "3 places)\n"));
  CHECK(lines_with(log, "warning: ") == 3); // and that of the missing light
  CHECK_THAT(log, Contains("info: c.obj: 2 zero-area triangles are dropped\n"));
}

TEST_CASE("Warnings of many objects are one of each kind, whatever numbers they name") {
  const std::string texture = "<bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\">"
                              "<string name=\"filename\" value=\"a.png\"/>\n<string name=\"filterType\" "
                              "value=\"trilinear\"/></texture></bsdf>\n";
  const std::string bright = "<bsdf type=\"phong\"><rgb name=\"specularReflectance\" value=\"";
  const std::string conserve = "<boolean name=\"ensureEnergyConservation\" value=\"true\"/>";
  const std::string dark =
      "<shape type=\"sphere\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"0\"/></emitter></shape>";
  const std::string log = log_of_files(
      {{"a.png", png()},
       {"scene.xml", with_sensor(texture + texture + bright + ".6\"/></bsdf>" + bright + ".7\"/></bsdf>" +
                                 conserve + dark + dark + "<emitter type=\"constant\"/>")}});
  CHECK_THAT(log, Contains("warning: scene.xml:3: 'trilinear' is not supported") &&
                      Contains("(the first of 2 places)") &&
                      Contains("reflects 1.100000 times what arrives; its reflectances are scaled by 0.9"));
  CHECK(lines_with(log, "warning: ") == 3);
}

TEST_CASE("A bsdf that several shapes refer to warns once, of one place") {
  const std::string log =
      log_of(with_sensor("<bsdf type=\"conductor\" id=\"m\"><rgb name=\"eta\" value=\"-1\"/></bsdf>\n"
                         "<shape type=\"sphere\"><ref id=\"m\"/></shape><shape type=\"disk\"><ref id=\"m\"/>"
                         "</shape><emitter type=\"constant\"/>"));
  CHECK(lines_with(log, "warning: ") == 1);
  CHECK_THAT(log, Contains("as in Mitsuba\n"));
}

TEST_CASE("Messages spell properties as the version of the file does") {
  const std::string bright = "<bsdf type=\"phong\"><rgb name=\"specular_reflectance\" value=\".6\"/></bsdf>";
  CHECK_THAT(error_in(bright, "3.0.0"),
             Contains("<boolean name=\"ensure_energy_conservation\" value=\"true\"/>"));
  CHECK_THAT(error_in(bright, "0.6.0"),
             Contains("<boolean name=\"ensureEnergyConservation\" value=\"true\"/>")); // either is read
  const auto crop = [](const std::string& version) {
    return error_of(scene_text("<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer "
                               "name=\"crop_width\" value=\"9999\"/></film></sensor>",
                               version));
  };
  CHECK_THAT(crop("3.0.0"), Contains("crop_offset_x + crop_width and crop_offset_y + crop_height"));
  CHECK_THAT(crop("0.6.0"), Contains("cropOffsetX + cropWidth and cropOffsetY + cropHeight"));
}
