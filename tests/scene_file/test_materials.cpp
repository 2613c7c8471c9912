#include <catch2/catch.hpp>

#include "materials.h"
#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Material;
using phlux::scene::Rgb;

namespace {

Material material(const std::string& bsdf, const std::string& version = "0.6.0") {
  return load_body("<shape type=\"disk\">" + bsdf + "</shape>", version).materials.at(0);
}

std::string phong(const std::string& kd, const std::string& ks, const std::string& more = "") {
  return "<bsdf type=\"phong\"><rgb name=\"diffuseReflectance\" value=\"" + kd +
         "\"/><rgb name=\"specularReflectance\" value=\"" + ks + "\"/>" + more + "</bsdf>";
}

Rgb color(const std::string& element) {
  return diffuse_of(material("<bsdf type=\"diffuse\">" + element + "</bsdf>"));
}

} // namespace

TEST_CASE("Mitsuba's defaults") {
  CHECK(diffuse_of(material("")) == Rgb(0.5)); // no bsdf
  CHECK(diffuse_of(material("<bsdf type=\"diffuse\"/>")) == Rgb(0.5));
  CHECK(specular_of(material("<bsdf type=\"diffuse\"/>")) == Rgb(0.0));
  const Material glossy = material("<bsdf type=\"phong\"/>");
  CHECK(glossy.model->name == "phong");
  CHECK(diffuse_of(glossy) == Rgb(0.5));
  CHECK(specular_of(glossy) == Rgb(0.2));
  CHECK(exponent_of(glossy) == 30.0);
  CHECK_FALSE(glossy.two_sided);
  CHECK(diffuse_of(material("<emitter type=\"area\"/>")) == Rgb(0.0)); // a light without a bsdf is black
}

TEST_CASE("Both spellings, all models") {
  CHECK(exponent_of(material(phong(".1", ".2", "<float name=\"exponent\" value=\"7\"/>"))) == 7.0);
  const std::string snake = "<bsdf type=\"phong\"><rgb name=\"diffuse_reflectance\" value=\".1\"/>"
                            "<rgb name=\"specular_reflectance\" value=\".3 .4 .5\"/></bsdf>";
  CHECK(diffuse_of(material(snake, "3.0.0")) == Rgb(0.1));
  CHECK(specular_of(material(snake, "3.0.0")) == Rgb(0.3, 0.4, 0.5));
  for (const char* names :
       {"<float name=\"exponentU\" value=\"5\"/><float name=\"exponentV\" value=\"6\"/>",
        "<float name=\"exponent_u\" value=\"5\"/><float name=\"exponent_v\" value=\"6\"/>"}) {
    const Material brushed = material("<bsdf type=\"anisotropicphong\">" + std::string(names) + "</bsdf>");
    CHECK(brushed.model->name == "anisotropicphong");
    CHECK(exponent_of(brushed) == 5.0);
    CHECK(exponent_v_of(brushed) == 6.0);
  }
  CHECK(diffuse_of(material(
            "<bsdf type=\"diffuse\"><rgb name=\"diffuseReflectance\" value=\".3\"/></bsdf>")) == Rgb(0.3));
}

TEST_CASE("twosided, around a nested or a referenced bsdf") {
  CHECK(material("<bsdf type=\"twosided\">" + phong(".1", ".2") + "</bsdf>").two_sided);
  const auto scene =
      load_body("<bsdf type=\"diffuse\" id=\"a\"/><shape type=\"disk\"><bsdf type=\"twosided\">"
                "<ref id=\"a\"/></bsdf></shape><shape type=\"disk\"><ref id=\"a\"/></shape>");
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].two_sided);
  CHECK_FALSE(scene.materials[1].two_sided);
  CHECK_THAT(error_in("<bsdf type=\"twosided\"/>"),
             StartsWith("scene.xml:2: <bsdf type=\"twosided\"> around nothing"));
  CHECK_THAT(error_in("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/>\n<bsdf type=\"diffuse\"/></bsdf>"),
             StartsWith("scene.xml:2: <bsdf type=\"twosided\"> around two bsdfs"));
}

TEST_CASE("Equal materials are one, and those that no shape uses are left out") {
  const auto scene =
      load_body("<bsdf type=\"diffuse\" id=\"unused\"><rgb name=\"reflectance\" value=\".9\"/></bsdf>"
                "<shape type=\"disk\"/><shape type=\"cube\"><bsdf type=\"diffuse\"/></shape>"
                "<shape type=\"disk\">" +
                phong(".5", "0") + "</shape>");
  CHECK(scene.materials.size() == 1);
  CHECK(scene.patches.size() == 8);
  for (const auto& patch : scene.patches) CHECK(patch.surface.material == 0);
}

TEST_CASE("Colours: one number, three, hexadecimal; rgb is linear, srgb is decoded") {
  CHECK(color(R"(<rgb name="reflectance" value=".25"/>)") == Rgb(0.25));
  CHECK(color(R"(<spectrum name="reflectance" value=".25"/>)") == Rgb(0.25));
  CHECK(color(R"(<float name="reflectance" value=".25"/>)") == Rgb(0.25));
  CHECK(color(R"(<rgb name="reflectance" value=".1, .2 .3"/>)") == Rgb(0.1, 0.2, 0.3));
  CHECK(color(R"(<spectrum name="reflectance" value=".1 .2 .3"/>)") == Rgb(0.1, 0.2, 0.3));
  CHECK(color(R"(<rgb name="reflectance" value="#ff8000"/>)") ==
        Rgb(1.0, 128.0 / 255.0, 0.0)); // as Mitsuba 0.6
  const Rgb decoded = color(R"(<srgb name="reflectance" value="#ff8000"/>)");
  CHECK(decoded.r == 1.0);
  CHECK(decoded.g == Approx(0.2158605));
  CHECK(decoded.b == 0.0);
  for (const char* bad : {"1 2", "#ff80", "#ff80zz", "#ff8000 #ff8000", "400:1, 700:2", "red", "", "1 2 3 4"})
    CHECK_THAT(error_in("<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"" + std::string(bad) +
                        "\"/></bsdf>"),
               StartsWith("scene.xml:3: '" + std::string(bad) + "' is not a colour"));
}

TEST_CASE("Impossible materials are errors") {
  CHECK_THAT(error_in("\n" + phong(".6", ".5")),
             StartsWith("scene.xml:3: <bsdf type=\"phong\"> reflects 1.1"));
  CHECK(error_in(phong(".7", ".3")).empty()); // exactly 1
  CHECK_THAT(error_in(phong("-.1", ".5")),
             StartsWith("scene.xml:2: ") && Contains("diffuseReflectance: -0.1"));
  CHECK_THAT(error_in("<bsdf type=\"diffuse\">\n<rgb name=\"reflectance\" value=\"0 0 1.5\"/></bsdf>"),
             StartsWith("scene.xml:3: ") && Contains("must be in [0, 1]"));
  CHECK_THAT(error_in("<bsdf type=\"phong\">\n<float name=\"exponent\" value=\"-1\"/></bsdf>"),
             StartsWith("scene.xml:3: ") && Contains("-1 is out of range"));
  CHECK_THAT(error_in("<bsdf type=\"hair\"/>"),
             StartsWith("scene.xml:2: <bsdf type=\"hair\"> is not supported: supported are diffuse, phong"));
  CHECK(error_in("<bsdf type=\"anisotropicphong\"><rgb name=\"specularReflectance\" value=\"1\"/></bsdf>")
            .empty());
}

TEST_CASE("ensureEnergyConservation scales by .99 / max, with a warning") {
  const std::string disk = "<shape type=\"disk\">" + phong(".6 .1 .1", ".5") + "</shape>";
  const std::string yes = "<boolean name=\"ensureEnergyConservation\" value=\"true\"/>";
  const auto scaled = load_body(disk + yes).materials.at(0); // on the scene, wherever it stands
  CHECK(diffuse_of(scaled).r == Approx(0.6 * 0.99 / 1.1));
  CHECK(diffuse_of(scaled).g == Approx(0.1 * 0.99 / 1.1));
  CHECK(specular_of(scaled).b == Approx(0.5 * 0.99 / 1.1));
  CHECK_THAT(log_of(with_sensor(disk + yes)),
             Contains("warning: scene.xml:2: <bsdf type=\"phong\"> reflects 1.1"));
  CHECK(specular_of(material(phong(".6", ".5", yes))).r == Approx(0.5 * 0.99 / 1.1)); // on the bsdf
  CHECK(load_body("<shape type=\"disk\">" + phong(".5", ".5") + "</shape>" + yes)
            .materials.at(0)
            .values.at(0)
            .r == 0.5);
}

TEST_CASE("Mirrors and metals: by name, by eta and k, and copper by default in version 0") {
  const auto conductor = [](const std::string& inside, const std::string& version = "0.6.0") {
    return material("<bsdf type=\"conductor\">" + inside + "</bsdf>", version);
  };
  const std::string none = "<string name=\"material\" value=\"none\"/>";
  CHECK(conductor(none).model->name == "mirror");
  CHECK(conductor("", "3.0.0").model->name == "mirror");
  CHECK(conductor("").value("k").r == Approx(3.27 / 1.000277));
  const std::string own = "<rgb name=\"eta\" value=\"0.2 0.4 1.4\"/><rgb name=\"k\" value=\"4\"/>";
  CHECK(conductor(own, "3.0.0").value("eta") == Rgb(0.2, 0.4, 1.4));
  CHECK(conductor(own + "<string name=\"extEta\" value=\"water\"/>").value("k").g == Approx(4 / 1.333));
  const Material gold = conductor("<string name=\"material\" value=\"Au\"/>", "3.0.0");
  CHECK(gold.value("eta").r < gold.value("eta").b);
  CHECK_THAT(error_in("<bsdf type=\"conductor\">\n<string name=\"material\" value=\"Xx\"/></bsdf>"),
             StartsWith("scene.xml:3: ") && Contains("no metal is named 'Xx'") && Contains("Au"));
  const std::string two =
      "<bsdf type=\"conductor\">\n<string name=\"material\" value=\"Au\"/>" + own + "</bsdf>";
  CHECK_THAT(error_in(two, "3.0.0"), StartsWith("scene.xml:3: "));
  CHECK(material(two).value("eta").r == Approx(0.2 / 1.000277));
  const std::string k = "<rgb name=\"k\" value=\"4\"/>";
  CHECK(conductor(k).value("eta") == conductor("").value("eta")); // of copper
  CHECK(conductor(k).value("k").r == Approx(4 / 1.000277));
  CHECK(conductor("<spectrum name=\"eta\" value=\"360:4 830:4\"/>", "3.0.0").value("eta").r ==
        Approx(4).epsilon(1e-3));
}

TEST_CASE("Dielectrics: indices of refraction as numbers and by Mitsuba's names") {
  const Material glass = material("<bsdf type=\"dielectric\"/>");
  CHECK(glass.value("int_ior").x == 1.5046);
  CHECK(glass.value("ext_ior").x == 1.000277);
  CHECK(glass.value("specular_transmittance") == Rgb(1));
  const std::string named = "<bsdf type=\"thindielectric\"><string name=\"intIOR\" value=\"diamond\"/>"
                            "<float name=\"extIOR\" value=\"1.1\"/></bsdf>";
  CHECK(material(named).value("int_ior").x == 2.419);
  CHECK(material(named).value("ext_ior").x == 1.1);
  CHECK(material("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"1.3\"/></bsdf>", "3.0.0")
            .value("int_ior")
            .x == 1.3);
  for (const char* bad : {"<string name=\"intIOR\" value=\"butter\"/>",
                          "<float name=\"intIOR\" value=\"0\"/>", "<float name=\"intIOR\" value=\"-1.5\"/>"})
    CHECK_THAT(error_in("<bsdf type=\"dielectric\">\n" + std::string(bad) + "</bsdf>"),
               StartsWith("scene.xml:3: ") && Contains("intIOR"));
  CHECK_THAT(error_in("<bsdf type=\"twosided\"><bsdf type=\"dielectric\"/></bsdf>"),
             StartsWith("scene.xml:2: ") && Contains("leave twosided out"));
}

TEST_CASE("Rough surfaces and plastic: Mitsuba's parameters and defaults") {
  const auto rough = [](const std::string& type, const std::string& inside) {
    return material("<bsdf type=\"" + type + "\">" + inside + "</bsdf>");
  };
  CHECK(rough("roughplastic", "").value("alpha").x == 0.1);
  CHECK(rough("roughplastic", "").value("int_ior").x == 1.49);
  CHECK(rough("roughplastic", "").value("lossy").x == 0); // as in 0.6
  CHECK(material("<bsdf type=\"roughplastic\"/>", "3.0.0").value("lossy").x == 1);
  CHECK(rough("roughconductor", "").value("k").r == Approx(3.27 / 1.000277)); // copper
  CHECK(rough("roughdielectric", "<string name=\"distribution\" value=\"ggx\"/>").value("distribution").x ==
        1);
  CHECK(rough("roughconductor", "<float name=\"alphaU\" value=\"0.3\"/><float name=\"alphaV\" value=\"0.3\"/>"
                                "<boolean name=\"sampleVisible\" value=\"false\"/>")
            .value("alpha")
            .x == 0.3);
  const Material brushed = rough("roughconductor", "<float name=\"alphaU\" value=\"0.3\"/>"); // alphaV: 0.1
  CHECK(brushed.model->name == "anisotropicconductor");
  CHECK(brushed.value("alpha_u").x == 0.3);
  CHECK(brushed.value("alpha_v").x == 0.1);
  CHECK(brushed.value("k").r == Approx(3.27 / 1.000277)); // copper
  const std::string two = "<float name=\"alphaU\" value=\"0.3\"/><float name=\"alphaV\" value=\"0.2\"/>";
  const std::string ggx = "<string name=\"distribution\" value=\"ggx\"/>";
  CHECK(rough("roughdielectric", two + ggx).model->name == "anisotropicdielectric");
  CHECK(rough("roughdielectric", two + ggx).value("distribution").x == 1);
  CHECK_THAT(error_in("<bsdf type=\"roughplastic\">\n" + two + "</bsdf>"),
             StartsWith("scene.xml:3: ") && Contains("a roughplastic of two roughnesses: one alpha"));
  CHECK_THAT(error_in("<bsdf type=\"roughconductor\">\n" + two +
                      "<string name=\"distribution\" value=\"phong\"/></bsdf>"),
             StartsWith("scene.xml:3: ") && Contains("a Phong distribution of two roughnesses"));
  CHECK(rough("plastic", "<boolean name=\"nonlinear\" value=\"true\"/>").value("nonlinear").x == 1);
  CHECK(rough("plastic", "<rgb name=\"specularReflectance\" value=\"0\"/>").model->name == "plastic");
  for (const char* bad : {"<float name=\"alpha\" value=\"0\"/>", "<float name=\"alphaV\" value=\"0\"/>",
                          "<string name=\"distribution\" value=\"cauchy\"/>"})
    CHECK_THAT(error_in("<bsdf type=\"roughconductor\">\n" + std::string(bad) + "</bsdf>"),
               StartsWith("scene.xml:3: "));
}

TEST_CASE(
    "What only rough surfaces have is passed over of smooth ones in files of version 0, as in Mitsuba") {
  const std::string rough =
      "<float name=\"alpha\" value=\".1\"/><string name=\"distribution\" value=\"ggx\"/></bsdf>";
  for (const char* type : {"conductor", "dielectric"}) {
    const std::string bsdf = "<bsdf type=\"" + std::string(type) + "\">\n" + rough;
    CHECK(material(bsdf).model->name == type);
    CHECK_THAT(error_in(bsdf, "3.0.0"), StartsWith("scene.xml:3: 'alpha' is not a property"));
  }
}

TEST_CASE("Channels of a metal's eta and k that are negative count as positive, with a warning") {
  const std::string metal = "<bsdf type=\"conductor\"><rgb name=\"eta\" value=\"-.25 4 5\"/><rgb name=\"k\" "
                            "value=\"1 -2 3\"/></bsdf>";
  CHECK(material(metal).value("eta") == Rgb(.25, 4, 5) / 1.000277);
  CHECK(material(metal).value("k") == Rgb(1, 2, 3) / 1.000277);
  CHECK_THAT(log_of_files({{"scene.xml", with_sensor("<shape type=\"disk\">" + metal + "</shape>")}}),
             Contains("a negative eta counts as positive") && Contains("a negative k"));
}

TEST_CASE("Masks: opacities, twosided inside and outside, and what they cannot be around") {
  const std::string half = "<float name=\"opacity\" value=\".5\"/>", grey = "<bsdf type=\"diffuse\"/>";
  const auto mask = [](const std::string& inside) { return "<bsdf type=\"mask\">" + inside + "</bsdf>"; };
  const auto twosided = [](const std::string& inside) {
    return "<bsdf type=\"twosided\">" + inside + "</bsdf>";
  };
  CHECK(material(mask(grey)).opacity == Rgb(0.5)); // Mitsuba's default
  CHECK(material(mask("<rgb name=\"opacity\" value=\".1 .2 .3\"/>" + grey)).opacity == Rgb(.1, .2, .3));
  CHECK(glm::length(material(mask("<rgb name=\"opacity\" value=\".1 .2 .3\"/>" + grey), "3.0.0").opacity -
                    Rgb(.2)) < 1e-12);
  CHECK_FALSE(material(mask("<float name=\"opacity\" value=\"1\"/>" + grey)).is_masked());
  CHECK(material(mask(half + mask(half + grey))).opacity == Rgb(0.25));
  for (const std::string& both : {mask(half + twosided(grey)), twosided(mask(half + grey))}) {
    CHECK(material(both).two_sided);
    CHECK(material(both).opacity == Rgb(0.5));
  }
  CHECK(material(mask(half + "<bsdf type=\"dielectric\"/>")).model->name == "dielectric");
  const Material simple = material(mask(half + phong(".3", "0")));
  CHECK(simple.model->name == "diffuse");
  CHECK(simple.opacity == Rgb(0.5));
  CHECK(load_body("<shape type=\"disk\">" + mask(half + grey) + "</shape><shape type=\"disk\">" + grey +
                  "</shape>")
            .materials.size() == 2);
  CHECK(material("<bsdf type=\"null\"/>").opacity == Rgb(0));
  CHECK_THAT(error_in(mask(half)), StartsWith("scene.xml:2: <bsdf type=\"mask\"> around nothing"));
  for (const char* wrong : {"-0.1", "1.1"})
    CHECK_THAT(error_in(mask("\n<float name=\"opacity\" value=\"" + std::string(wrong) + "\"/>" + grey)),
               StartsWith("scene.xml:3: ") && Contains("must be in [0, 1]"));
  CHECK_THAT(error_in("<shape type=\"disk\">" + mask(half + grey) + "\n<emitter type=\"area\"/></shape>"),
             StartsWith("scene.xml:3: ") && Contains("a masked shape that emits is not supported"));
}

TEST_CASE("Equal materials are one, of many that differ") {
  std::string body;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 2000; ++i)
      body += "<shape type=\"disk\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" +
              std::to_string(i / 2000.0) + "\"/></bsdf></shape>\n";
  const auto scene = load_body(body);
  CHECK(scene.materials.size() == 2000);
  CHECK(scene.patches.at(7).surface.material == scene.patches.at(2007).surface.material);
}
