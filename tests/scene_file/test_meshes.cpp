#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include <glm/geometric.hpp>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Mesh;
using phlux::scene::Vec3;

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string ply_header(const std::string& format, int vertices, int faces, const std::string& more = "") {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\nelement vertex " +
         std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n" + more +
         "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string ascii_square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

template<class Number>
std::string stored(Number value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string binary_square(bool big_endian) {
  std::string bytes = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian", 4, 1);
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
    bytes += stored(x, big_endian);
  bytes += stored(std::uint8_t{4}, big_endian);
  for (const std::int32_t i : {0, 1, 2, 3}) bytes += stored(i, big_endian);
  return bytes;
}

Vec3 front(const Mesh& mesh, std::size_t triangle = 0) {
  const auto& t = mesh.triangles.at(triangle);
  const Vec3 p = mesh.positions.at(t[0]);
  return glm::normalize(glm::cross(mesh.positions.at(t[1]) - p, mesh.positions.at(t[2]) - p));
}

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += 0.5 * glm::length(glm::cross(mesh.positions.at(t[1]) - mesh.positions.at(t[0]),
                                        mesh.positions.at(t[2]) - mesh.positions.at(t[0])));
  return sum;
}

const std::string flat = R"(<boolean name="faceNormals" value="true"/>)";
const std::string flipped = R"(<boolean name="flipNormals" value="true"/>)";
const std::string mirrored = R"(<transform name="toWorld"><scale z="-1"/></transform>)";

} // namespace

TEST_CASE("PLY in all three formats, polygons as fans") {
  for (const auto& bytes : {ply_header("ascii", 4, 1) + ascii_square + "4 0 1 2 3\n", binary_square(false),
                            binary_square(true)}) {
    const Mesh mesh = load_mesh("ply", bytes);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 2);
    CHECK(area(mesh) == Approx(1.0));
    CHECK(front(mesh) == Vec3(0, 0, 1));
  }
}

TEST_CASE(
    "PLY: other properties and elements are passed over, other types are read, lines may end with CR LF") {
  const std::string bytes =
      "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement camera 1\r\nproperty list uchar float view\r\n"
      "element vertex 3\r\nproperty uchar red\r\nproperty double x\r\nproperty double y\r\n"
      "property short z\r\nproperty list uchar int extra\r\nelement face 1\r\nproperty uchar flags\r\n"
      "property list uint uint vertex_index\r\nend_header\r\n"
      "2 5 6\r\n9 0 0 0 1 7\r\n9 1 0 0 0\r\n9 0 1.5 0 0\r\n8 3 0 1 2\r\n";
  const Mesh mesh = load_mesh("ply", bytes);
  CHECK(mesh.positions.at(2) == Vec3(0, 1.5, 0));
  CHECK(mesh.triangles.size() == 1);
}

TEST_CASE("PLY that is broken is an error that says where") {
  CHECK_THAT(mesh_error("ply", ""), StartsWith("mesh.ply:1: the PLY header has no end"));
  CHECK_THAT(mesh_error("ply", "plx\n"), StartsWith("mesh.ply:1: not a PLY file"));
  CHECK_THAT(mesh_error("ply", "ply\nformat ascii 2.0\nend_header\n"),
             StartsWith("mesh.ply:2: unknown PLY format"));
  CHECK_THAT(mesh_error("ply", "ply\nformat ascii 1.0\nelement vertex many\n"),
             StartsWith("mesh.ply:3: malformed PLY element"));
  CHECK_THAT(mesh_error("ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n"),
             StartsWith("mesh.ply:4: 'quad' is not a PLY type"));
  CHECK_THAT(mesh_error("ply", "ply\nend_header\n"),
             StartsWith("mesh.ply:2: the PLY header states no format"));
  CHECK_THAT(mesh_error("ply", "ply\nformat ascii 1.0\nend_header\n"),
             StartsWith("mesh.ply: the PLY header needs one element vertex"));
  const std::string head = ply_header("ascii", 4, 1); // 10 lines
  CHECK_THAT(mesh_error("ply", head + ascii_square + "3 0 1 4\n"),
             StartsWith("mesh.ply:15: face 0 has a vertex index out of range: 0 to 3"));
  CHECK_THAT(mesh_error("ply", head + ascii_square + "3 0 1 -1\n"), StartsWith("mesh.ply:15: face 0"));
  CHECK_THAT(mesh_error("ply", head + "0 0 0\n1 nan 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
             StartsWith("mesh.ply:12: vertex 1 is not finite"));
  CHECK_THAT(mesh_error("ply", head + "0 0 0\n1 x 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
             StartsWith("mesh.ply:12: 'x' is not a number"));
  CHECK_THAT(mesh_error("ply", head + ascii_square + "3 0 1"),
             StartsWith("mesh.ply:15: the file is cut short"));
  CHECK_THAT(mesh_error("ply", head + ascii_square + "3 0 1 2\n5\n"),
             StartsWith("mesh.ply:16: data after the last row"));
  CHECK_THAT(mesh_error("ply", ply_header("ascii", 2000000000, 1) + ascii_square),
             Contains("the file is cut short"));
  CHECK_THAT(mesh_error("ply", ply_header("ascii", 4, 0) + ascii_square),
             StartsWith("mesh.ply: the mesh has no triangles"));
}

TEST_CASE("Errors about binary data are one line of ASCII") {
  const std::string rubbish = ply_header("ascii", 1, 1) + std::string("\xff\x01\x80 0 0\n", 8);
  CHECK_THAT(mesh_error("ply", rubbish), StartsWith("mesh.ply:11: '\?\?\?' is not a number"));
  CHECK_THAT(error_in("<bsdf type=\"a&#10;b\"/>"),
             StartsWith("scene.xml:2: <bsdf type=\"a?b\"> is not supported"));
}

TEST_CASE("A mesh cut short anywhere is an error, never a crash") {
  for (const bool big_endian : {false, true}) {
    const std::string bytes = binary_square(big_endian);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      CHECK_FALSE(mesh_error("ply", bytes.substr(0, size)).empty());
  }
  const std::string ascii = ply_header("ascii", 4, 1) + ascii_square + "4 0 1 2 3";
  for (std::size_t size = 0; size < ascii.size(); ++size)
    CHECK_FALSE(mesh_error("ply", ascii.substr(0, size)).empty());
  const std::string obj = square + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
  for (std::size_t size = 0; size < obj.size(); ++size) CHECK_NOTHROW(mesh_error("obj", obj.substr(0, size)));
}

TEST_CASE("OBJ: every form of face, negative indices, comments, continued lines, several groups") {
  for (const char* face : {"f 1 2 3 4", "f -4 -3 -2 -1", "f 1/1 2/1 3/1 4/1", "f 1//1 2//1 3//1 4//1",
                           "f 1// 2// 3// 4//", "f 1/1/ 2/1/ 3/1/ 4/1/", "f 1/1/1 2/1/1 3/1/1 4/1/1",
                           "f 1 2 \\\n 3 4", "o a\nf 1 2 3\ns b\no c\nf 1 3 4", "  f\t1  2 3 4 # quad"}) {
    INFO(face);
    const std::string lines = "# square\n" + square + "vt 0 0\nvn 0 0 1\n" + face + "\n";
    const Mesh mesh = load_mesh("obj", lines);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 2);
    CHECK(area(mesh) == Approx(1.0));
    CHECK(front(mesh) == Vec3(0, 0, 1));
  }
  CHECK(load_mesh("obj", square + "f 1 2 3").triangles.size() == 1); // no line end
}

TEST_CASE("OBJ: broken lines are errors with their number") {
  CHECK_THAT(mesh_error("obj", square + "f 1 2 9\n"),
             StartsWith("mesh.obj:5: index 9 of a vertex is out of range: 4 were given"));
  CHECK_THAT(mesh_error("obj", square + "f 1 2 -5\n"), StartsWith("mesh.obj:5: index -5"));
  CHECK_THAT(mesh_error("obj", square + "f 0 1 2\n"), StartsWith("mesh.obj:5: index 0"));
  CHECK_THAT(mesh_error("obj", square + "\nf 1//1 2//1 3//1\n"),
             StartsWith("mesh.obj:6: index 1 of a normal"));
  CHECK_THAT(mesh_error("obj", square + "f 1/2 2/2 3/2\n"),
             StartsWith("mesh.obj:5: index 2 of a texture coordinate"));
  CHECK_THAT(mesh_error("obj", square + "f 1 2 x\n"), StartsWith("mesh.obj:5: 'x' is no index"));
  CHECK_THAT(mesh_error("obj", "v 0 0 0\nv 0 nan 0\n"),
             StartsWith("mesh.obj:2: vertex with 'nan' for a coordinate"));
  CHECK_THAT(mesh_error("obj", "v 0 0 0\nv 0 1\n"),
             StartsWith("mesh.obj:2: vertex with '' for a coordinate"));
  CHECK_THAT(mesh_error("obj", "v 0 0 0\nv 0 1 1e40\n"), StartsWith("mesh.obj:2: vertex with '1e40'"));
  CHECK_THAT(mesh_error("obj", square), StartsWith("mesh.obj: the mesh has no triangles"));
}

TEST_CASE("Triangles without area are dropped, and a warning counts them") {
  const std::string bytes = square + "v 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 5\nf 1 2\n";
  CHECK(load_mesh("obj", bytes).triangles.size() == 1);
  CHECK_THAT(mesh_log("obj", bytes),
             Contains("warning: mesh.obj: 2 zero-area triangles are dropped") &&
                 Contains("warning: mesh.obj: 1 faces with fewer than three corners"));
}

TEST_CASE("Text files may begin with the mark of UTF-8; in UTF-16 they are refused") {
  const std::string mark = "\xEF\xBB\xBF", ply = ply_header("ascii", 4, 1) + ascii_square + "4 0 1 2 3\n";
  CHECK(load_mesh("obj", mark + square + "f 1 2 3 4\n").positions.front() == Vec3(0, 0, 0));
  CHECK(area(load_mesh("ply", mark + ply)) == Approx(1.0));
  CHECK(area(load_mesh("ply", mark + binary_square(false))) == Approx(1.0));
  CHECK(error_of(mark + with_sensor("")).empty());
  CHECK_THAT(mesh_error("obj", std::string("\xFF\xFEv\0 \0", 6)), Contains("' is in UTF-16"));
  CHECK_THAT(error_of("\xFE\xFF"), StartsWith("scene.xml:1: is in UTF-16"));
}

TEST_CASE("OBJ: a backslash inside a line is part of a word, and is an error in a face") {
  CHECK_THAT(mesh_error("obj", square + "f 1 3\\4\n"), StartsWith("mesh.obj:5: '3\\4' is no index"));
  CHECK_THAT(mesh_error("obj", square + "f 1 3 \\ \n4\n"), StartsWith("mesh.obj:5: '\\' is no index"));
  CHECK(load_mesh("obj", square + "usemtl a\\b\nf 1 2 3\\\n4\n").triangles.size() == 2);
}

TEST_CASE("OBJ: lines of other kinds than polygons are passed over, with one warning") {
  CHECK_THAT(
      mesh_log("obj", square + "f 1 2 3\ncurv 0 1 1 2\nxyz\nl 1 2\n"),
      Contains("warning: mesh.obj:6: 'curv' is no line of a polygon mesh: 2 such lines are passed over"));
  CHECK_THAT(mesh_log("obj", square + "g a\no b\ns 1\nusemtl c\nl 1 2\np 1\n# d\n\nf 1 2 3\n"),
             !Contains("mesh.obj"));
}

TEST_CASE("Numbers: a plus sign, and less than the smallest double, which is 0") {
  for (const std::string zero : {"+0", "1e-400", "-1e-400", "0.000e-99999"}) {
    CHECK(load_mesh("obj", "v " + zero + " 0 0\nv +1 0 0\nv 0 +1e0 0\nf 1 2 3\n").positions.front() ==
          Vec3(0));
    CHECK(load_mesh("ply", ply_header("ascii", 3, 1) + zero + " 0 0\n+1 0 0\n0 +1e0 0\n+3 0 1 2\n")
              .positions.front() == Vec3(0));
  }
  CHECK_THAT(mesh_error("obj", "v 1e400 0 0\n"), StartsWith("mesh.obj:1: vertex with '1e400'"));
  CHECK_THAT(mesh_error("ply", ply_header("ascii", 1, 1) + "1e400 0 0\n3 0 0 0\n"),
             StartsWith("mesh.ply:11: vertex 0 is not finite"));
}

TEST_CASE("PLY: the length of a list is a whole number of 0 or more") {
  for (const std::string count : {"-3", "2.5", "nan", "inf"})
    CHECK_THAT(mesh_error("ply", ply_header("ascii", 4, 1) + ascii_square + count + " 0 1 2\n"),
               StartsWith("mesh.ply:15: a list of "));
}

TEST_CASE("OBJ: many vertices at one position take linear time") {
  std::string lines = square;
  constexpr int count = 100'000; // with a chain per position 5e9 steps
  for (int i = 1; i <= count; ++i) lines += "vn " + std::to_string(i) + " 0 1\n";
  for (int i = 1; i <= count; ++i) lines += "f 1//" + std::to_string(i) + " 2//1 3//1\n";
  CHECK(load_mesh("obj", lines).positions.size() == count + 2);
}

TEST_CASE("Normals of the file are used, interpolated; faceNormals leaves them out") {
  const std::string bytes = square + "vn 0 0 2\nvn 1 0 1\nf 1//1 2//2 3//1\n";
  const Mesh smooth = load_mesh("obj", bytes);
  REQUIRE(smooth.normals.size() == 3);
  CHECK(smooth.normals[0] == glm::vec3(0, 0, 1)); // made unit
  CHECK(glm::length(smooth.normals[1] - glm::normalize(glm::vec3(1, 0, 1))) < 1e-6f);
  CHECK(load_mesh("obj", bytes, flat).normals.empty());
  const std::string ply =
      ply_header("ascii", 3, 1, "property float nx\nproperty float ny\nproperty float nz\n") +
      "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 .6 .8\n3 0 1 2\n";
  CHECK(glm::length(load_mesh("ply", ply).normals.at(2) - glm::vec3(0, .6f, .8f)) < 1e-6f);
  CHECK(load_mesh("ply", ply, flat).normals.empty());
  CHECK_THAT(mesh_error("ply", ply_header("ascii", 1, 1,
                                          "property float nx\nproperty float ny\nproperty float nz\n") +
                                   "0 0 0 nan 0 1\n3 0 0 0\n"),
             StartsWith("mesh.ply:14: normal 0 is not finite"));
}

TEST_CASE("Normals that the file does not give are computed, weighted by angle, unless faceNormals is set") {
  // A right-angled edge: at its ends the normals of the two squares have equal weights.
  const std::string edge = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 0 1\nv 0 1 1\nf 1 4 3 2\nf 1 2 6 5\n";
  const Mesh mesh = load_mesh("obj", edge);
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].x == 0.0 && mesh.positions[i].z == 0.0)
      CHECK(glm::length(Vec3(mesh.normals[i]) - glm::normalize(Vec3(1, 0, 1))) < 1e-6);
  CHECK(load_mesh("obj", edge, flat).normals.empty());
  // An angle of 1e-29, whose square is below single precision.
  CHECK(load_mesh("obj", "v 0 0 0\nv 1 0 0\nv 1 9e28 0\nf 1 2 3\n").normals.at(2) == glm::vec3(0, 0, 1));
  CHECK(load_mesh("ply", ply_header("ascii", 4, 1) + ascii_square + "4 0 1 2 3\n").normals.at(0) ==
        glm::vec3(0, 0, 1));
}

TEST_CASE("Computed normals are not smooth between groups in 0.x, unless collapse is set") {
  const std::string edge = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 0 1\nv 0 1 1\ng a\nf 1 4 3 2\n";
  for (const std::string border : {"g b\n", "usemtl b\n"}) {
    const Mesh split = load_mesh("obj", edge + border + "f 1 2 6 5\n");
    CHECK(split.positions.size() == 8);
    for (const glm::vec3& n : split.normals) CHECK((n == glm::vec3(0, 0, 1) || n == glm::vec3(1, 0, 0)));
    CHECK(load_mesh("obj", edge + border + "f 1 2 6 5\n", R"(<boolean name="collapse" value="true"/>)")
              .positions.size() == 6);
  }
}

TEST_CASE("The front side: by the file's normals where there are, by the order of the vertices elsewhere") {
  CHECK(front(load_mesh("obj", square + "f 4 3 2 1\n")) == Vec3(0, 0, -1));
  const std::string against = square + "vn 0 0 1\nf 4//1 3//1 2//1 1//1\n";
  CHECK(front(load_mesh("obj", against)) == Vec3(0, 0, 1));
  CHECK(front(load_mesh("obj", against, flat)) == Vec3(0, 0, -1));
}

TEST_CASE("The front side of meshes under flipNormals and mirroring") {
  for (const std::string& face :
       {std::string("f 1 2 3 4\n"), std::string("vn 0 0 1\nf 1//1 2//1 3//1 4//1\n")})
    for (const std::string& shading : {std::string(), flat}) {
      const auto check = [&](const std::string& properties, double z) {
        const Mesh mesh = load_mesh("obj", square + face, shading + properties);
        CHECK(front(mesh) == Vec3(0, 0, z));
        CHECK(front(mesh, 1) == Vec3(0, 0, z));
        for (const auto& normal : mesh.normals) CHECK(Vec3(normal) == Vec3(0, 0, z));
      };
      check("", 1.0);
      check(flipped, -1.0);
      // As in Mitsuba: normals of the file keep their side, and without them the front follows the order of
      // the transformed vertices, which a mirror reverses as seen from a fixed side.
      const bool by_normals = face.starts_with("vn") && shading.empty();
      check(mirrored, by_normals ? -1.0 : 1.0);
      check(mirrored + flipped, by_normals ? 1.0 : -1.0);
      check(R"(<transform name="toWorld"><scale x="-1"/></transform>)", by_normals ? 1.0 : -1.0);
    }
}

TEST_CASE("Normals go with the inverse transpose") {
  const Mesh mesh = load_mesh("obj", "v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n",
                              R"(<transform name="toWorld"><scale x="3"/></transform>)");
  CHECK(glm::length(Vec3(mesh.normals.at(0)) - front(mesh)) < 1e-6);
}

TEST_CASE("A mesh that leaves single precision's range is an error") {
  const TemporaryFolder folder;
  CHECK_THROWS(load_mesh("obj", "v 1e30 0 0\nv 0 1e30 0\nv 0 0 0\nf 1 2 3\n",
                         R"(<transform name="toWorld"><scale value="1e20"/></transform>)"));
}
