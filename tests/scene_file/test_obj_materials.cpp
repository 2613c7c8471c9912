#include <catch2/catch.hpp>

#include <cmath>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Rgb;

namespace {

const std::string obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                        "usemtl green grass\nf 1 2 3\ng second\nf 1 2 4\nusemtl red\nf 2 3 4\nf 1 3 4\n";

Files files(const std::string& inside, const std::string& library = "",
            const std::string& version = "0.6.0") {
  Files result{
      {"m.obj", obj},
      {"scene.xml",
       with_sensor("<bsdf type=\"diffuse\" id=\"blue\"><rgb name=\"reflectance\" value=\"0 0 1\"/></bsdf>"
                   "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>" +
                       inside + "</shape>",
                   version)}};
  if (!library.empty()) result["m.mtl"] = library;
  return result;
}

std::string named(const std::string& name, const std::string& color) {
  return "<bsdf type=\"diffuse\" name=\"" + name + "\"><rgb name=\"reflectance\" value=\"" + color +
         "\"/></bsdf>";
}

struct Part {
  std::size_t triangles;
  phlux::scene::Material material;
};

std::vector<Part> parts(const Files& all) {
  const auto scene = load_files(all);
  std::vector<Part> result;
  for (const auto& mesh : scene.meshes)
    result.push_back(
        {mesh.triangles.size(), scene.materials.at(static_cast<std::size_t>(mesh.surface.material))});
  return result;
}

} // namespace

TEST_CASE("bsdfs with a name are of the parts with this usemtl; others are of the whole file") {
  const auto both = parts(files(named("red", "1 0 0") + "<ref name=\"green grass\" id=\"blue\"/>"));
  REQUIRE(both.size() == 2);
  CHECK(both[0].triangles == 2);
  CHECK(both[0].material.value("reflectance") == Rgb(0, 0, 1));
  CHECK(both[1].material.value("reflectance") == Rgb(1, 0, 0));
  const auto one = parts(files(named("red", "1 0 0")));
  CHECK(one.at(0).material.value("reflectance") == Rgb(.5));
  for (const std::string& whole :
       {std::string("<ref id=\"blue\"/>"), named("red", "1 0 0") + "<ref id=\"blue\"/>",
        std::string("<ref name=\"bsdf\" id=\"blue\"/>")})
    for (const auto& part : parts(files(whole))) CHECK(part.material.value("reflectance") == Rgb(0, 0, 1));
  CHECK(parts(files("<ref name=\"any\" id=\"blue\"/>", "", "3.0.0")).size() ==
        1); // Mitsuba 3 has no such rule
}

TEST_CASE("Without a bsdf, the materials of the .mtl file, by Mitsuba 0.6's rules") {
  const auto linear = [](double x) { return std::pow((x + .055) / 1.055, 2.4); };
  const std::string library =
      "newmtl red\n  Kd .5 0 0\nKs .2 .2 .2\nNs 30\nillum 2\n# c\nnewmtl green grass\nKd 0 1 0\nillum 1\n";
  const auto found = parts(files("", library));
  REQUIRE(found.size() == 2);
  CHECK(found[0].material.value("reflectance") == Rgb(0, 1, 0));
  CHECK(found[1].material.model->name == "phong");
  CHECK(found[1].material.value("exponent").x == 30.0);
  CHECK(found[1].material.value("diffuse_reflectance").x == Approx(linear(.5)));
  CHECK(found[1].material.value("specular_reflectance").y == Approx(linear(.2)));
  const auto bright = parts(files("", "newmtl red\nKd 1 1 1\nKs 1 1 1\nNs 9\nillum 2\n"));
  CHECK(bright.at(1).material.value("diffuse_reflectance").x == Approx(.495)); // scaled to .99, as in Mitsuba
  CHECK(parts(files("<boolean name=\"loadMaterials\" value=\"false\"/>", library)).size() == 1);
  CHECK(parts(files("<boolean name=\"collapse\" value=\"true\"/>", library)).size() == 1);
  CHECK_THAT(log_of_files(files("")), Contains("m.mtl' cannot be read"));
  CHECK_THAT(log_of_files(files("", "newmtl red\nmap_Kd a.png\n")),
             Contains("m.mtl:2: map_Kd of a material library"));
  CHECK_THAT(error_of_files(files("", "newmtl red\nKd 1 x 1\n")), StartsWith("m.mtl:2: a malformed colour"));
}

TEST_CASE("shapeIndex of an obj file counts its groups") {
  const auto index = [](int i) {
    return "<ref id=\"blue\"/><integer name=\"shapeIndex\" value=\"" + std::to_string(i) + "\"/>";
  };
  CHECK(parts(files(index(0))).at(0).triangles == 1);
  CHECK(parts(files(index(2))).at(0).triangles == 2);
  CHECK_THAT(error_of_files(files(index(3))), Contains("the file has no part 3: a shape index from 0 to 2"));
}
