// The tables of scenes/FORMAT.md against what the readers accept.
#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scene/digest.h"
#include "scene_file/images.h"
#include "scene_file/scenes.h"

using namespace phlux;
using namespace phlux::test;

namespace {

struct Row {
  std::string property, element, otherwise;
};

struct Section { ///< "### TAG: TYPE, TYPE"
  std::string tag;
  std::vector<std::string> types;
  std::vector<Row> rows;
  std::set<std::string> ignored;
  bool ignores_others = false;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) {
    const std::size_t first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

// The texts between backticks.
std::vector<std::string> code_in(const std::string& line) {
  std::vector<std::string> texts;
  const std::vector<std::string> parts = split(line, '`');
  for (std::size_t i = 1; i < parts.size(); i += 2) texts.push_back(parts[i]);
  return texts;
}

std::vector<Section> sections_of_page() {
  std::istringstream page(TemporaryFolder::read(PHLUX_SOURCE_DIR "/scenes/FORMAT.md"));
  std::vector<Section> sections;
  bool inside = false; // a section of an element
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with('#')) {
      inside = line.starts_with("### ");
      if (!inside) continue;
      const std::size_t colon = line.find(':');
      sections.push_back({line.substr(4, colon - 4), split(line.substr(colon + 1), ','), {}, {}});
    }
    if (!inside) continue;
    Section& section = sections.back();
    if (line.starts_with("| `")) {
      const std::vector<std::string> cells = split(line, '|');
      section.rows.push_back({code_in(cells.at(1)).at(0), cells.at(2), cells.at(3)});
    }
    if (line.starts_with("Ignored: "))
      for (const std::string& name : code_in(line)) section.ignored.insert(name);
    if (line == "All other properties are ignored.") section.ignores_others = true;
  }
  return sections;
}

// What an object of this type needs.
std::string needs(const std::string& tag, const std::string& type) {
  if (tag == "shape" && (type == "obj" || type == "ply"))
    return fmt::format(R"(<string name="filename" value="a.{}"/>)", type);
  if (type == "bitmap" || type == "envmap") return R"(<string name="filename" value="a.png"/>)";
  if (type == "thinlens") return R"(<float name="aperture_radius" value="1"/>)";
  if (type == "scale") return R"(<texture type="checkerboard"/>)";
  if (type == "mask") return R"(<bsdf type="diffuse"/>)";
  if (type == "instance") return R"(<ref id="group"/>)";
  return "";
}

// A scene with one object of the type that has these properties.
Files scene_with(const std::string& tag, const std::string& type, const std::string& properties) {
  std::string object = fmt::format("<{0} type=\"{1}\">{2}{3}</{0}>", tag, type, needs(tag, type), properties);
  std::string sensor = R"(<sensor type="perspective"/>)", light = R"(<emitter type="constant"/>)", rest;
  if (tag == "sensor")
    sensor = object;
  else if (tag == "film" || tag == "sampler")
    sensor = R"(<sensor type="perspective">)" + object + "</sensor>";
  else if (tag == "rfilter")
    sensor = R"(<sensor type="perspective"><film type="hdrfilm">)" + object + "</film></sensor>";
  else if (tag == "bsdf" || (tag == "emitter" && type == "area"))
    rest = R"(<shape type="sphere">)" + object + "</shape>";
  else if (tag == "texture")
    rest = R"(<shape type="sphere"><bsdf type="diffuse">)" + object.insert(8, R"( name="reflectance")") +
           "</bsdf></shape>";
  else if (tag == "emitter")
    light = object;
  else
    rest = object;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                          "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                          "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  return {{"scene.xml", "<scene version=\"3.0.0\">\n" + sensor + light +
                            R"(<shape type="shapegroup" id="group"><shape type="disk"/></shape>)" + rest +
                            R"(<shape type="cube"/></scene>)"},
          {"a.obj", mesh},
          {"a.ply", ply},
          {"a.png", png()}};
}

// The names in "... supported are a, b" of the error about an unknown property.
std::set<std::string> supported(const std::string& tag, const std::string& type) {
  const std::string error = error_of_files(scene_with(tag, type, R"(<float name="unknown" value="1"/>)"));
  CAPTURE(error);
  const std::string mark = "supported are ";
  const std::size_t at = error.find(mark);
  REQUIRE(at != std::string::npos);
  std::string list = error.substr(at + mark.size());
  list.resize(std::min(list.size(), list.find('\n')));
  const std::vector<std::string> names = split(list, ',');
  return {names.begin(), names.end()};
}

// The property with the default that the row states; empty if it states none that can be written.
std::string with_default(const Row& row) {
  if (row.otherwise.find('`') != std::string::npos || row.otherwise.find(' ') != std::string::npos) {
    if (row.element != "point") return "";
  }
  if (row.element == "transform") return fmt::format("<transform name=\"{}\"/>", row.property);
  std::string element = row.element;
  if (element == "number") element = "float";
  if (element == "colour") element = "rgb";
  if (element == "string" && row.otherwise == "none" && row.property == "filename") return "";
  return fmt::format("<{} name=\"{}\" value=\"{}\"/>", element, row.property, row.otherwise);
}

// What a scene is, in a text.
std::string content(const Files& files) {
  const scene::Scene scene = load_files(files);
  const scene::RenderDefaults& d = scene.defaults;
  return fmt::format("{} {} {} {} {} {} {}", scene::digest(scene), d.integrator, d.samples_per_pixel,
                     d.max_depth, d.rr_depth, scene.camera.width, scene.camera.height);
}

} // namespace

TEST_CASE("The page of the scene format has every property of every type, and no other") {
  const std::vector<Section> sections = sections_of_page();
  CHECK(sections.size() > 30);
  for (const Section& section : sections)
    for (const std::string& type : section.types) {
      if (type == "serialized") continue; // as obj
      CAPTURE(section.tag, type);
      std::set<std::string> names = section.ignored;
      for (const Row& row : section.rows) names.insert(row.property);
      if (section.ignores_others) {
        CHECK(error_of_files(scene_with(section.tag, type, R"(<float name="unknown" value="1"/>)")).empty());
        continue;
      }
      if (section.tag == "bsdf") names.insert("ensure_energy_conservation");
      CHECK(names == supported(section.tag, type));
    }
}

TEST_CASE("The page of the scene format has every type") {
  for (const char* tag : {"integrator", "sensor", "film", "rfilter", "shape", "bsdf", "texture", "emitter"}) {
    const std::string error = error_of_files(scene_with(tag, "unknown", ""));
    for (const Section& section : sections_of_page())
      for (const std::string& type : section.types)
        if (section.tag == tag) {
          CAPTURE(tag, error);
          CHECK_THAT(error, Catch::Contains(type));
        }
  }
}

TEST_CASE("The defaults of the page of the scene format are those of the readers") {
  for (const Section& section : sections_of_page())
    for (const std::string& type : section.types) {
      if (type == "serialized") continue;
      for (const Row& row : section.rows) {
        const std::string given = with_default(row);
        if (given.empty() || row.property == "eta" || row.property == "k") continue; // which exclude material
        CAPTURE(section.tag, type, given);
        CHECK(content(scene_with(section.tag, type, given)) == content(scene_with(section.tag, type, "")));
      }
    }
}
