#include <catch2/catch.hpp>

#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "scene_file/scenes.h"
#include "scene_file/spectrum.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Rgb;
using phlux::scene_file::color_of;
using phlux::scene_file::Illuminant;

namespace {

Rgb reflectance(const std::string& property, const std::string& version = "3.0.0") {
  const auto scene =
      load_body("<shape type=\"sphere\"><bsdf type=\"diffuse\">" + property + "</bsdf></shape>", version);
  return scene.materials.at(static_cast<std::size_t>(scene.spheres.at(0).surface.material))
      .value("reflectance");
}

Rgb radiance(const std::string& property, const std::string& version = "3.0.0") {
  return load_body("<emitter type=\"constant\">" + property + "</emitter>", version)
      .constant_radiance.value();
}

bool near(const Rgb& a, const Rgb& b, double error) {
  CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
  return glm::compMax(glm::abs(a - b)) <= error;
}

std::string pairs(const std::string& name, const std::string& values) {
  return "<spectrum name=\"" + name + "\" value=\"" + values + "\"/>";
}

} // namespace

TEST_CASE("A constant spectrum is grey as a reflectance, and of equal energy as emission and in 0.x") {
  const Rgb equal_energy(1.2048, 0.9483, 0.9087); // XYZ = (1, 1, 1)
  CHECK(near(reflectance(pairs("reflectance", "360:.6, 830:.6")), Rgb(.6), 1e-4));
  CHECK(near(radiance(pairs("radiance", "360:2, 830:2")), 2.0 * equal_energy, 2e-3));
  CHECK(near(radiance(pairs("radiance", "2")), 2.0 * equal_energy, 1e-3));
  CHECK(radiance(pairs("radiance", "2"), "0.6.0") == Rgb(2.0));
  CHECK(near(reflectance(pairs("reflectance", "360:.6 830:.6"), "0.6.0"), .6 * equal_energy, 1e-3));
}

TEST_CASE("Spectra become the colours of the CIE's tables, up to the stated error") {
  // Exact: sums over the tables of CIE 15, interpolated to 1 nm.
  using Spectrum = std::vector<phlux::scene_file::SpectralValue>;
  const Spectrum green{{450, 0}, {540, 1}, {630, 0}}, ramp{{380, 0}, {780, 1}};
  CHECK(near(color_of(green, Illuminant::equal), Rgb(0.11049, 0.80301, 0.03093), 0.01));
  CHECK(near(color_of(green, Illuminant::d65), Rgb(0.05761, 0.84048, 0.04563), 0.01));
  CHECK(near(color_of(ramp, Illuminant::d65), Rgb(0.65611, 0.40750, 0.15205), 0.01));
  for (const auto& [kelvin, exact] : {std::pair{2000.0, Rgb(16.01413, 4.11187, 0.13036)},
                                      std::pair{5000.0, Rgb(15262.95, 12082.73, 9591.83)},
                                      std::pair{10000.0, Rgb(158407.5, 180719.8, 260006.1)}})
    CHECK(near(color_of(phlux::scene_file::black_body(kelvin), Illuminant::equal), exact,
               0.02 * glm::compMax(exact)));
}

TEST_CASE("In 0.x a spectrum falls to 0 beyond its ends within the mean distance of its points") {
  CHECK(reflectance(pairs("reflectance", "450:.1, 550:.8, 650:.6"), "0.6.0") ==
        reflectance(pairs("reflectance", "350:0, 450:.1, 550:.8, 650:.6, 750:0"), "0.6.0"));
  CHECK(reflectance(pairs("reflectance", "450:.1, 550:.8, 650:.6"), "3.0.0") ==
        reflectance(pairs("reflectance", "449.999:0, 450:.1, 550:.8, 650:.6, 650.001:0"), "3.0.0"));
}

TEST_CASE("Forms of colours: xyz, black bodies, plugins of Mitsuba 2 and 3, files") {
  CHECK(near(reflectance("<xyz name=\"reflectance\" value=\".95047 1 1.08883\"/>"), Rgb(1.0), 1e-4));
  const Rgb body = radiance("<blackbody name=\"radiance\" temperature=\"5000K\" scale=\".001\"/>", "0.6.0");
  CHECK(near(body, Rgb(15.26295, 12.08273, 9.59183), .1));
  CHECK(radiance("<spectrum type=\"blackbody\" name=\"radiance\"><float name=\"temperature\" value=\"5000\"/>"
                 "<float name=\"scale\" value=\".001\"/></spectrum>") == body);
  CHECK(radiance("<spectrum type=\"d65\" name=\"radiance\"><float name=\"scale\" value=\"4\"/></spectrum>") ==
        Rgb(4.0));
  CHECK(radiance(
            "<spectrum type=\"uniform\" name=\"radiance\"><float name=\"value\" value=\"4\"/></spectrum>") ==
        Rgb(4.0));
  CHECK(near(
      reflectance(
          "<spectrum type=\"regular\" name=\"reflectance\"><float name=\"wavelength_min\" value=\"360\"/>"
          "<float name=\"wavelength_max\" value=\"830\"/><string name=\"values\" "
          "value=\".3,.3,.3\"/></spectrum>"),
      Rgb(.3), 1e-4));
  CHECK(near(reflectance("<spectrum type=\"irregular\" name=\"reflectance\"><string name=\"wavelengths\" "
                         "value=\"360, 830\"/>"
                         "<string name=\"values\" value=\".3, .3\"/></spectrum>"),
             Rgb(.3), 1e-4));
  const std::string scene =
      with_sensor("<emitter type=\"constant\"><spectrum name=\"radiance\" filename=\"lamp.spd\"/></emitter>");
  const std::string spd = "# a lamp\n360 2\n 600\t2 # still 2\n\n830 2\n";
  CHECK(near(load_files({{"scene.xml", scene}, {"lamp.spd", spd}}).constant_radiance.value(),
             radiance(pairs("radiance", "360:2, 830:2")), 1e-6));
  CHECK_THAT(error_of_files({{"scene.xml", scene}}),
             StartsWith("scene.xml:2: spectrum '") && Contains("cannot be read"));
  CHECK_THAT(error_of_files({{"scene.xml", scene}, {"lamp.spd", "1 2\n1 2 3\n"}}),
             StartsWith("lamp.spd:2: a malformed line"));
}

TEST_CASE("Spectra: bad ones are errors, channels outside the gamut are clamped, the error is said once") {
  const auto error = [](const std::string& values) {
    return error_in("<emitter type=\"constant\">\n" + pairs("radiance", values) + "</emitter>");
  };
  for (const char* values : {"400:1, 300:2", "400:1, 400:2"})
    CHECK_THAT(error(values), StartsWith("scene.xml:3: the wavelengths of the spectrum do not increase"));
  for (const char* values : {"400:1, 500", "400:1, 500:x", "-3:1, 4:5", "400:1:2"})
    CHECK_THAT(error(values), StartsWith("scene.xml:3: a malformed spectrum"));
  CHECK_THAT(
      error_in("<emitter type=\"constant\"><blackbody name=\"radiance\" temperature=\"-5\"/></emitter>"),
      Contains("'-5' is not a temperature"));
  CHECK_THAT(
      error_in("<emitter type=\"constant\"><spectrum name=\"radiance\" type=\"neon\"/></emitter>", "3.0.0"),
      Contains("<spectrum type=\"neon\"> is not supported"));
  const Rgb laser = radiance(pairs("radiance", "495:0, 500:1, 505:0"));
  CHECK(laser.x == 0.0);
  CHECK(laser.y > 0.0);
  const std::string both = log_of(
      with_sensor("<emitter type=\"constant\">" + pairs("radiance", "400:1, 700:1") +
                  "</emitter><emitter type=\"point\">" + pairs("intensity", "400:1, 700:2") + "</emitter>"));
  CHECK(both.find("CIE 1931") != std::string::npos);
  CHECK(both.find("CIE 1931") == both.rfind("CIE 1931"));
}
