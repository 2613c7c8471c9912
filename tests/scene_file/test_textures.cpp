#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <spdlog/spdlog.h>

#include "errors.h"
#include "materials.h"
#include "scene_file/images.h"
#include "scene_file/load.h"
#include "scene_file/scenes.h"

using namespace phlux;
using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using scene::Rgb;
using scene::Texture;
using scene::TexturePointer;

namespace {

const std::string file = "<string name=\"filename\" value=\"a.png\"/>";

// A <texture> for a parameter.
std::string bitmap(const std::string& more = "", const std::string& attributes = "name=\"reflectance\"") {
  return "<texture type=\"bitmap\" " + attributes + ">" + file + more + "</texture>";
}
std::string disk(const std::string& inside, const std::string& model = "diffuse") {
  return "<shape type=\"disk\"><bsdf type=\"" + model + "\">" + inside + "</bsdf></shape>";
}

// A scene beside a.png, of 2x2 pixels, and other files.
scene::Scene load_beside(const std::string& body, const std::string& version = "0.6.0",
                         const std::map<std::string, std::string>& files = {}) {
  const TemporaryFolder folder;
  folder.write("a.png", png());
  for (const auto& [name, bytes] : files) folder.write(name, bytes);
  folder.write("scene.xml", with_sensor(body, version));
  const auto level = spdlog::default_logger()->level();
  spdlog::set_level(spdlog::level::off);
  scene::Scene scene;
  try {
    scene = scene_file::load(folder / "scene.xml");
  } catch (const SceneError& error) {
    spdlog::set_level(level);
    throw SceneError(without_folder(error.what(), folder));
  }
  spdlog::set_level(level);
  return scene;
}

std::string error_beside(const std::string& body, const std::map<std::string, std::string>& files = {}) {
  try {
    static_cast<void>(load_beside(body, "0.6.0", files));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TexturePointer texture_of(const std::string& body, const std::string& version = "0.6.0") {
  return load_beside(body, version).materials.at(0).texture(0);
}

} // namespace

TEST_CASE("A bitmap for a reflectance: nested, by reference, of every model") {
  const TexturePointer texture = texture_of(disk(bitmap()));
  REQUIRE(texture);
  CHECK(texture->image->bytes.size() == 16);
  CHECK_FALSE(texture->nearest);
  CHECK(texture->wrap_u == Texture::Wrap::repeat);
  CHECK(texture->to_uv == std::array<double, 6>{1, 0, 0, 0, 1, 0});
  CHECK(static_cast<double>(texture->image->decoded[128]) == Approx(0.2158605).epsilon(1e-6)); // sRGB
  const auto by_id = load_beside(bitmap("", "id=\"t\"") + disk("<ref name=\"reflectance\" id=\"t\"/>") +
                                 disk("<ref name=\"diffuseReflectance\" id=\"t\"/>", "anisotropicphong"));
  REQUIRE(by_id.materials.size() == 2);
  CHECK(by_id.materials[0].texture(0));
  CHECK(by_id.materials[1].texture(0)->image == by_id.materials[0].texture(0)->image); // read once
  CHECK_FALSE(by_id.materials[1].texture(1));
  CHECK(load_beside(disk(bitmap()) + disk(bitmap())).materials.size() == 1); // equal materials are one
  CHECK(load_beside(disk(bitmap()) + disk(bitmap("<float name=\"uscale\" value=\"2\"/>"))).materials.size() ==
        2);
  for (const char* model : {"phong", "anisotropicphong"})
    CHECK(load_beside(disk(bitmap("", "name=\"diffuseReflectance\"") +
                               "<rgb name=\"specularReflectance\" value=\"0\"/>",
                           model))
              .materials.at(0)
              .texture(0));
}

TEST_CASE("A bitmap for the opacity of a mask: by its colours or one channel") {
  const auto opacity_of = [](const std::string& channel, const std::string& version = "0.6.0") {
    const std::string image = "<string name=\"filename\" value=\"alpha.png\"/>";
    const std::string name = channel.empty() ? "" : "<string name=\"channel\" value=\"" + channel + "\"/>";
    const auto scene =
        load_beside("<shape type=\"disk\"><bsdf type=\"mask\"><texture type=\"bitmap\" name=\"opacity\">" +
                        image + name + "</texture><bsdf type=\"diffuse\"/></bsdf></shape>",
                    version, {{"alpha.png", png_with_alpha()}});
    return scene.materials.at(0);
  };
  for (const auto& [channel, first] : {std::pair("r", 255), {"g", 128}, {"b", 0}, {"a", 64}}) {
    CAPTURE(channel);
    const scene::Material material = opacity_of(channel);
    REQUIRE(material.opacity_texture);
    CHECK(material.is_textured());
    CHECK(material.opacity_texture->image->bytes[0] == first);
    CHECK(material.opacity_texture->image->bytes[2] == first);
  }
  CHECK(static_cast<double>(opacity_of("a").opacity_texture->image->decoded[128]) == Approx(128 / 255.0));
  CHECK(static_cast<double>(opacity_of("g").opacity_texture->image->decoded[128]) == Approx(0.2158605));
  CHECK(opacity_of("").opacity.r == 1);
  // From version 2 on, the luminance of 255 128 0 in sRGB.
  const auto number = opacity_of("", "3.0.0").opacity_texture->image;
  CHECK(number->bytes.empty());
  CHECK(static_cast<double>(number->floats.at(0)) == Approx(0.212671 + 0.715160 * 0.2158605));
  CHECK(number->floats.at(2) == number->floats.at(0));
  CHECK_THROWS_WITH(opacity_of("x"), Contains("'x' is not supported: r, g, b or a"));
}

TEST_CASE("Encodings, filters, wrap modes and transforms of textures") {
  const auto decoded = [](const std::string& more) {
    return static_cast<double>(texture_of(disk(bitmap(more)))->image->decoded[128]);
  };
  CHECK(decoded("<float name=\"gamma\" value=\"1\"/>") == Approx(128 / 255.0).epsilon(1e-7));
  CHECK(decoded("<float name=\"gamma\" value=\"2\"/>") == Approx(128 / 255.0 * 128 / 255.0).epsilon(1e-6));
  CHECK(decoded("<boolean name=\"raw\" value=\"true\"/>") == Approx(128 / 255.0).epsilon(1e-7));
  CHECK(decoded("<float name=\"gamma\" value=\"-1\"/>") == Approx(0.2158605).epsilon(1e-6));
  CHECK(texture_of(disk(bitmap("<string name=\"filterType\" value=\"nearest\"/>")))->nearest);
  const TexturePointer wrapped = texture_of(disk(
      bitmap("<string name=\"wrapMode\" value=\"mirror\"/><string name=\"wrapModeV\" value=\"clamp\"/>")));
  CHECK(wrapped->wrap_u == Texture::Wrap::mirror);
  CHECK(wrapped->wrap_v == Texture::Wrap::clamp);
  CHECK(texture_of(disk(bitmap("<float name=\"uscale\" value=\"2\"/><float name=\"voffset\" value=\".5\"/>")))
            ->to_uv == std::array<double, 6>{2, 0, 0, 0, 1, .5});
  const TexturePointer turned =
      texture_of(disk(bitmap("<transform name=\"to_uv\"><rotate z=\"1\" angle=\"90\"/>"
                             "<translate x=\".25\" y=\"3\"/></transform>")),
                 "3.0.0");
  const std::array<double, 6> expected{0, -1, .25, 1, 0, 3};
  for (std::size_t i = 0; i < 6; ++i) CHECK(turned->to_uv[i] == Approx(expected[i]).margin(1e-15));
}

TEST_CASE("A checkerboard: Mitsuba's default colours, or two others") {
  const TexturePointer plain = texture_of(disk("<texture type=\"checkerboard\" name=\"reflectance\"/>"));
  CHECK_FALSE(plain->image);
  CHECK(plain->colors == std::array<Rgb, 2>{Rgb(.4), Rgb(.2)});
  const TexturePointer coloured = texture_of(
      disk("<texture type=\"checkerboard\" name=\"reflectance\"><rgb name=\"color0\" value=\".1 .9 0\"/>"
           "<srgb name=\"color1\" value=\"#ffffff\"/></texture>"));
  CHECK(coloured->colors == std::array<Rgb, 2>{Rgb(.1, .9, 0), Rgb(1)});
  CHECK(coloured->largest() == Rgb(1));
}

TEST_CASE("Energy is conserved by the largest texels") {
  const std::string white = bitmap("", "name=\"diffuseReflectance\""); // red reaches 1
  const std::string specular = "<rgb name=\"specularReflectance\" value=\".25\"/>";
  CHECK_THAT(error_beside("\n" + disk(white + specular, "phong")),
             StartsWith("scene.xml:3: <bsdf type=\"phong\"> reflects 1.25"));
  const scene::Material scaled =
      load_beside(
          disk(white + specular + "<boolean name=\"ensureEnergyConservation\" value=\"true\"/>", "phong"))
          .materials.at(0);
  CHECK(scaled.texture(0)->scale == Approx(.99 / 1.25));
  CHECK(diffuse_of(scaled).r == Approx(.99 / 1.25));
  CHECK(specular_of(scaled).r == Approx(.25 * .99 / 1.25));
  CHECK_THAT(error_beside(disk("<texture type=\"checkerboard\" name=\"reflectance\"><rgb name=\"color1\" "
                               "value=\"1.5\"/></texture>")),
             StartsWith("scene.xml:2: ") && Contains("1.5 is out of range: every channel must be in [0, 1]"));
  // ks = 0 is a diffuse material, with its texture.
  const scene::Material simple =
      load_beside(disk(white + "<rgb name=\"specularReflectance\" value=\"0\"/>", "phong")).materials.at(0);
  CHECK(simple.model->name == "diffuse");
  CHECK(simple.texture(0));
}

TEST_CASE("Wrong textures are errors") {
  CHECK_THAT(
      error_beside("\n" + disk("<texture type=\"bitmap\" name=\"reflectance\">\n<string name=\"filename\" "
                               "value=\"b.png\"/></texture>")),
      StartsWith("scene.xml:4: image file 'b.png' cannot be read: an existing file"));
  CHECK_THAT(error_beside(disk("<texture type=\"bitmap\" name=\"reflectance\"/>")),
             Contains("without a filename"));
  CHECK_THAT(error_beside(disk(bitmap()), {{"a.png", png().substr(0, 60)}}),
             StartsWith("scene.xml:2: image file 'a.png': the image is cut short: the whole file"));
  CHECK_THAT(error_beside(disk("<texture type=\"fractal\" name=\"reflectance\"/>")),
             Contains("<texture type=\"fractal\"> is not supported: supported are bitmap, checkerboard"));
  CHECK_THAT(error_beside(disk(bitmap("<string name=\"wrapMode\" value=\"zero\"/>"))),
             Contains("wrapMode: 'zero' is not supported: repeat, mirror or clamp"));
  CHECK_THAT(error_beside(disk(bitmap("<string name=\"filterType\" value=\"cubic\"/>"))),
             Contains("bilinear or nearest"));
  CHECK_THAT(error_beside(disk(bitmap("<float name=\"gamma\" value=\"-2\"/>"))),
             Contains("-2 is no encoding"));
  CHECK_THAT(error_beside(disk(bitmap("<float name=\"gama\" value=\"1\"/>"))),
             Contains("'gama' is not a property"));
  CHECK_THAT(error_beside(disk(bitmap("", "name=\"reflectanc\""))),
             Contains("'reflectanc' is not a property"));
  CHECK_THAT(error_beside(disk(bitmap("", ""))), Contains("without a name"));
  CHECK_THAT(error_beside(disk(bitmap("", "name=\"exponent\""), "phong")),
             Contains("'exponent' is a <texture>: it must be one of <float>"));
  CHECK_THAT(error_beside(disk(bitmap() + "<rgb name=\"reflectance\" value=\"1\"/>")),
             Contains("given twice"));
  CHECK_THAT(error_beside("<emitter type=\"constant\">" + bitmap("", "name=\"radiance\"") + "</emitter>"),
             Contains("'radiance' is a <texture>"));
  CHECK_THAT(error_beside(disk(bitmap("<string name=\"wrapMode\" value=\"zero\"/>"))), Contains("wrapMode"));
  CHECK_THAT(error_beside("<shape type=\"disk\">" + bitmap() + "</shape>"),
             Contains("'reflectance' is not a property"));
}

TEST_CASE("Shapes have Mitsuba's texture coordinates") {
  const auto scene =
      load_beside("<shape type=\"rectangle\"/><shape type=\"cube\"/><shape type=\"disk\"><boolean "
                  "name=\"flipNormals\" value=\"true\"/></shape><shape type=\"sphere\"><transform "
                  "name=\"toWorld\"><rotate x=\"1\" angle=\"90\"/></transform></shape>");
  const auto at = [&](std::size_t patch, double u, double v) {
    const auto& uv = scene.patches[patch].uv;
    return uv[0] + u * uv[1] + v * uv[2];
  };
  CHECK(at(0, -1, 1) == glm::dvec2(0, 1));
  // The corner of each face where Mitsuba's cube has (0, 1).
  const scene::Vec3 corners[] = {{-1, -1, 1}, {1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {1, 1, -1}, {1, -1, 1}};
  for (std::size_t face = 0; face < 6; ++face) {
    CAPTURE(face);
    const scene::Patch& patch = scene.patches[1 + face];
    const scene::Vec3 from_center = corners[face] - patch.origin;
    CHECK(at(1 + face, glm::dot(from_center, patch.edge_u), glm::dot(from_center, patch.edge_v)) ==
          glm::dvec2(0, 1));
  }
  CHECK(at(7, 0.5, -1) == glm::dvec2(0.5, 1)); // its second edge is along -y
  CHECK(scene.spheres[0].axes[1].z == Approx(1));
}

TEST_CASE("Texture coordinates of meshes, read where the material has textures") {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .25 .75\nvt 1\nvt 0 1\nf 1/1 2/2 3/3\n";
  const auto mesh = [&](const std::string& bsdf, const std::string& more = "") {
    return load_beside("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>" + more + bsdf +
                           "</shape>",
                       "0.6.0", {{"m.obj", obj}})
        .meshes.at(0);
  };
  const std::string textured = "<bsdf type=\"diffuse\">" + bitmap() + "</bsdf>";
  using Coordinates = std::vector<glm::vec2>;
  CHECK(mesh(textured).texture_coordinates == Coordinates{{.25f, .25f}, {1, 1}, {0, 0}}); // flipped
  CHECK(mesh(textured, "<boolean name=\"flipTexCoords\" value=\"false\"/>").texture_coordinates ==
        Coordinates{{.25f, .75f}, {1, 0}, {0, 1}});
  CHECK(mesh("<bsdf type=\"anisotropicphong\"/>").texture_coordinates.size() == 3);
  CHECK(mesh("").texture_coordinates.empty());
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
      "float z\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar int "
      "vertex_indices\nend_header\n";
  const auto ply =
      load_beside("<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/>" + textured + "</shape>",
                  "0.6.0", {{"m.ply", header + "0 0 0 0 .5\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"}});
  CHECK(ply.meshes.at(0).texture_coordinates == Coordinates{{0, .5f}, {1, 0}, {0, 1}});
  CHECK_THAT(
      error_beside("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>" + textured + "</shape>",
                   {{"m.obj", "v 0 0 0\nvt 1 x\n"}}),
      StartsWith("m.obj:2: texture coordinate with 'x' for a number"));
}

TEST_CASE("scale multiplies the texture inside by a number, a checkerboard also by a colour") {
  const auto scaled = [](const std::string& factor, const std::string& inside) {
    return "<texture type=\"scale\" name=\"reflectance\">" + factor + inside + "</texture>";
  };
  const std::string half = "<float name=\"scale\" value=\"0.5\"/>";
  const auto reflectance = [](const std::string& body) {
    return load_beside(body).materials.at(0).texture(0);
  };
  const auto bitmap_half = reflectance(disk(scaled(half, bitmap("", ""))));
  CHECK(bitmap_half->scale == 0.5);
  CHECK(bitmap_half->largest() == 0.5 * reflectance(disk(bitmap()))->largest());
  CHECK(reflectance(disk(scaled(half, scaled(half, bitmap()))))->scale == 0.25); // with names too
  const std::string checkerboard = "<texture type=\"checkerboard\" id=\"c\"/>";
  const std::string red = "<rgb name=\"scale\" value=\"1 0 0\"/>";
  CHECK(reflectance(checkerboard + disk(scaled(red, "<ref id=\"c\"/>")))->colors[0] ==
        phlux::scene::Rgb(0.4, 0, 0));
  CHECK_THAT(error_beside(disk(scaled("\n" + red, bitmap("", "")))),
             StartsWith("scene.xml:3: <texture type=\"scale\">: scale: a bitmap with a colour: <float"));
  CHECK_THAT(error_beside(disk(scaled(half, ""))),
             Contains("<texture type=\"scale\"> around nothing: one nested"));
  CHECK_THAT(error_beside(disk(scaled("<float name=\"scale\" value=\"-1\"/>", bitmap()))),
             Contains("a negative factor: 0 or more"));
  CHECK_THAT(error_beside(disk(scaled("<float name=\"scale\" value=\"2\"/>", bitmap()))),
             Contains("is out of range: every channel must be in [0, 1]"));
}
