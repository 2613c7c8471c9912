// The example of a user's own reflectance model, scenes/lobes/retro.cl.
#include <cmath>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>

#include "errors.h"
#include "images/evidence.h"
#include "images/integrators.h"
#include "images/scenes.h"
#include "phong/reflectivity.h"
#include "scene_file/load.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::test;

namespace {

const std::filesystem::path folder = PHLUX_SOURCE_DIR "/scenes/lobes";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

lobes::Library library_with_retro() {
  lobes::Library library;
  library.add(folder / "retro.cl");
  return library;
}

scene::Material retro(const scene::Rgb& reflectance, double share, double exponent) {
  scene::Material material;
  material.model = library_with_retro().find("retro");
  material.values = {reflectance, scene::Rgb(share), scene::Rgb(exponent)};
  return material;
}

// A sphere that fills the image, under a sky; the camera is at distance 4 of its centre.
scene::Scene furnace(const scene::Material& material) {
  scene::Scene scene;
  scene.materials = {material};
  scene.spheres = {{{0, 0, 0}, 1, false, {0, -1}}};
  scene.constant_radiance = scene::Rgb(1.0, 0.5, 2.0);
  scene.camera = look_at({0, 0, 4}, {0, 0, 0}, 18, 6, 6);
  return scene;
}

} // namespace

TEST_CASE("retro.cl declares its parameters, and is short") {
  const auto model = library_with_retro().find("retro");
  REQUIRE(model);
  REQUIRE(model->parameters.size() == 3);
  CHECK(model->parameters[0].name == "reflectance");
  CHECK(model->parameters[1].name == "share");
  CHECK(model->parameters[2].name == "exponent");
  CHECK(model->parameters[2].lowest == 1);
  CHECK_FALSE(model->reflectivity_is_estimate);
  const std::string text = text_of(folder / "retro.cl");
  CHECK(std::ranges::count(text, '\n') < 60);
}

TEST_CASE("A model's file may have Windows' line ends, and may define a macro in two branches") {
  TemporaryFolder other;
  std::string text;
  for (const char c : text_of(folder / "retro.cl")) text += c == '\n' ? "\r\n" : std::string(1, c);
  text += "#ifdef RETRO_FAST\r\n#define RETRO_TRANSMITS 0\r\n#else\r\n# define RETRO_TRANSMITS 1 // or "
          "not\r\n#endif\r\n"
          "#define RETRO_HAS_DELTA_NOT 1\r\n";
  std::ofstream(other.path() / "retro.cl", std::ios::binary) << text;
  lobes::Library library;
  library.add(other.path() / "retro.cl");
  const auto model = library.find("retro"), original = library_with_retro().find("retro");
  CHECK(model->parameters.size() == original->parameters.size());
  CHECK(model->parameters[2].meaning == original->parameters[2].meaning);
  CHECK(model->derived_words == original->derived_words);
  CHECK(model->transmits);
  CHECK_FALSE(model->has_delta);
}

TEST_CASE("The page about retro.cl shows every line of it, in order") {
  const std::string page = text_of(folder / "README.md");
  const std::string open = "```c\n", close = "```\n";
  std::string shown;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::size_t end = page.find(close, at);
    REQUIRE(end != std::string::npos);
    if (!shown.empty()) shown += '\n'; // a blank line between the parts
    shown += page.substr(at, end - at);
    at = end;
  }
  CHECK(shown == text_of(folder / "retro.cl"));
}

TEST_CASE("retro.xml needs the model, and loads with it") {
  CHECK_THROWS_AS(scene_file::load(folder / "retro.xml"), SceneError);
  const scene::Scene scene = scene_file::load(folder / "retro.xml", {}, {}, library_with_retro());
  CHECK(std::ranges::count_if(scene.materials, [](const scene::Material& m) {
          return m.model->name == "retro" && m.value("exponent").x == 100 && m.value("share").x == 0.3;
        }) == 1);
}

// Radiance is the sky's times the reflectivity R (1 - s + s rho_s), with the rho_s of the Phong lobe.
TEST_CASE("retro.cl in a furnace: the reflectivity in every pixel") {
  const scene::Rgb reflectance(0.9, 0.5, 0.2);
  for (const double exponent : {1.0, 20.0, 1e5})
    for (const double share : {0.6, 1.0}) {
      const scene::Scene scene = furnace(retro(reflectance, share, exponent));
      const Estimate reference = expected(scene.camera, [&](const scene::Vec3& direction) {
        const double along = 4 * direction.z, cosine = std::sqrt(along * along - 15);
        const double part = 1 - share + share * phong::lobe_reflectivity(exponent, std::min(cosine, 1.0));
        return Channels{reflectance.r * part, 0.5 * reflectance.g * part, 2 * reflectance.b * part};
      });
      for (const Method& method : {path, path_hits, bidir}) {
        CAPTURE(exponent, share, name_of(method));
        const Render image = render_of(scene, by(method, settings_for(1024)));
        CHECK(image.statistics.nonfinite == 0);
        check_agreement(estimate_of(image.film), reference, 5e-5);
      }
    }
}

TEST_CASE("retro.cl in a room: path, light and bidirectional tracing agree") {
  scene::Scene scene = from_xml(R"(<scene version="0.6.0">
    <sensor type="perspective"><float name="fov" value="38"/>
      <transform name="toWorld"><lookat origin="0, 1, 4" target="0, 1, 0" up="0, 1, 0"/></transform>
      <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
    <bsdf type="diffuse" id="a"><rgb name="reflectance" value=".7"/></bsdf>
    <bsdf type="diffuse" id="b"><rgb name="reflectance" value=".5"/></bsdf>
    <bsdf type="diffuse" id="black"><rgb name="reflectance" value="0"/></bsdf>
    <shape type="rectangle"><transform name="toWorld"><scale value="2"/><rotate x="1" angle="-90"/></transform><ref id="a"/></shape>
    <shape type="rectangle"><transform name="toWorld"><scale value="2"/><translate y="1" z="-1.5"/></transform><ref id="b"/></shape>
    <shape type="sphere"><point name="center" x=".3" y=".9" z="-.2"/><float name="radius" value=".6"/><ref id="b"/></shape>
    <shape type="sphere"><point name="center" x="-.6" y="2.9" z="1"/><float name="radius" value=".5"/><ref id="black"/>
      <emitter type="area"><rgb name="radiance" value="9, 7, 5"/></emitter></shape>
  </scene>)");
  scene.materials[1] = retro({0.9, 0.7, 0.5}, 0.7, 15);
  check_against_path(scene, {light, bidir, bidir_power, path_light_samples}, settings_for(64, 5), 2);
}
