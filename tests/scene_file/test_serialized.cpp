#include <catch2/catch.hpp>

#include <bit>

#include <zlib.h>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Vec3;

namespace {

template<class Number>
std::string little(Number value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

std::string real(double value, bool in_double) {
  return in_double ? little(std::bit_cast<std::uint64_t>(value))
                   : little(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

constexpr std::uint32_t normals = 1, texture = 2, colours = 8, flat = 16, in_single = 0x1000,
                        in_double = 0x2000;

/// A triangle (0, 0, 0), (size, 0, 0), (0, size, 0) with normals (0, 0, 1) in Mitsuba's format.
std::string triangle(std::uint16_t version, std::uint32_t flags, double size, std::uint32_t last_index = 2) {
  const bool is_double = (flags & in_double) != 0;
  std::string content = little(flags);
  if (version == 4) content += std::string("a name") + '\0';
  content += little(std::uint64_t{3}) + little(std::uint64_t{1});
  for (const double x : {0., 0., 0., size, 0., 0., 0., size, 0.}) content += real(x, is_double);
  if (flags & normals)
    for (const double x : {0., 0., 1., 0., 0., 1., 0., 0., 1.}) content += real(x, is_double);
  if (flags & texture)
    for (const double x : {.5, .25, .5, .25, .5, .25}) content += real(x, is_double);
  for (int i = 0; i < ((flags & colours) ? 9 : 0); ++i) content += real(.5, is_double);
  for (const std::uint32_t i : {0U, 1U, last_index}) content += little(i);
  std::string packed(compressBound(content.size()), '\0');
  uLongf length = packed.size();
  REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &length,
                   reinterpret_cast<const Bytef*>(content.data()), content.size()) == Z_OK);
  return little(std::uint16_t{0x041C}) + little(version) + packed.substr(0, length);
}

std::string file_of(const std::vector<std::string>& meshes, std::uint16_t version = 4) {
  std::string bytes, offsets;
  for (const auto& mesh : meshes) {
    offsets +=
        version == 4 ? little(std::uint64_t{bytes.size()}) : little(static_cast<std::uint32_t>(bytes.size()));
    bytes += mesh;
  }
  return bytes + offsets + little(static_cast<std::uint32_t>(meshes.size()));
}

std::string index(int i) {
  return "<integer name=\"shapeIndex\" value=\"" + std::to_string(i) + "\"/>";
}

} // namespace

TEST_CASE("Serialized meshes: both versions, precisions, and every combination of contents") {
  for (const std::uint16_t version : {std::uint16_t{3}, std::uint16_t{4}})
    for (const std::uint32_t precision : {in_single, in_double})
      for (std::uint32_t contents = 0; contents < 32; ++contents) {
        if (contents & 4) continue;
        CAPTURE(version, precision, contents);
        const auto mesh =
            load_mesh("serialized", file_of({triangle(version, precision | contents, 3.0)}, version));
        REQUIRE(mesh.positions.size() == 3);
        CHECK(mesh.positions[1] == Vec3(3, 0, 0));
        CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
        CHECK(mesh.normals.size() == ((contents & flat) ? 0 : 3));
        CHECK(mesh.texture_coordinates.empty()); // the material needs none
        for (const auto& normal : mesh.normals) CHECK(normal == glm::vec3(0, 0, 1));
      }
}

TEST_CASE("Texture coordinates of serialized meshes") {
  const std::string anisotropic = "<bsdf type=\"anisotropicphong\"/>";
  for (const std::uint32_t precision : {in_single, in_double}) {
    const std::string file = file_of({triangle(4, precision | normals | texture | colours, 1.0)});
    const auto mesh = load_mesh("serialized", file, anisotropic);
    CHECK(mesh.texture_coordinates == std::vector<glm::vec2>(3, glm::vec2(.5f, .25f)));
    CHECK(mesh.triangles.size() == 1);
  }
  CHECK(load_mesh("serialized", triangle(4, in_single, 1.0), anisotropic).texture_coordinates.empty());
}

TEST_CASE("shapeIndex chooses a mesh of a serialized file") {
  for (const std::uint16_t version : {std::uint16_t{3}, std::uint16_t{4}}) {
    std::vector<std::string> meshes;
    for (int i = 0; i < 3; ++i) meshes.push_back(triangle(version, in_single, i + 1.0));
    const std::string file = file_of(meshes, version);
    CHECK(load_mesh("serialized", file).positions.at(1).x == 1.0);
    for (int i = 0; i < 3; ++i) CHECK(load_mesh("serialized", file, index(i)).positions.at(1).x == i + 1.0);
    const std::string scene = with_sensor(
        "<shape type=\"serialized\"><string name=\"filename\" value=\"m\"/>" + index(3) + "</shape>");
    CHECK_THAT(error_of_files({{"scene.xml", scene}, {"m", file}}),
               StartsWith("m: the file has no mesh 3: a shape index from 0 to 2"));
  }
}

TEST_CASE("Serialized meshes that are broken are errors") {
  CHECK_THAT(mesh_error("serialized", ""), StartsWith("mesh.serialized: the file is cut short"));
  CHECK_THAT(mesh_error("serialized", "ply\nformat"), StartsWith("mesh.serialized: not a serialized mesh"));
  CHECK_THAT(mesh_error("serialized", triangle(5, in_single, 1.0)),
             Contains("version 5 of the format is not supported"));
  CHECK_THAT(mesh_error("serialized", triangle(4, in_single, 1.0, 3)),
             Contains("vertex index out of range: 0 to 2"));
  CHECK_THAT(mesh_error("serialized", triangle(4, in_single, HUGE_VAL)), Contains("is not finite"));
  const std::string whole = triangle(4, in_single | normals, 1.0);
  for (std::size_t size = 0; size < whole.size() - 8; ++size) // the end has the checksum
    CHECK_FALSE(mesh_error("serialized", whole.substr(0, size)).empty());
  for (std::size_t i = 4; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(~changed[i]);
    CHECK_NOTHROW(mesh_error("serialized", changed));
  }
}

TEST_CASE("A serialized file that claims more than it holds is refused before memory is taken") {
  std::string content = little(in_single) + std::string("x") + '\0' + little(std::uint64_t{4'000'000'000}) +
                        little(std::uint64_t{1});
  std::string packed(compressBound(content.size()), '\0');
  uLongf length = packed.size();
  REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &length,
                   reinterpret_cast<const Bytef*>(content.data()), content.size()) == Z_OK);
  CHECK_THAT(mesh_error("serialized",
                        little(std::uint16_t{0x041C}) + little(std::uint16_t{4}) + packed.substr(0, length)),
             Contains("a mesh of 4000000000 vertices or triangles"));
}
