#include "random/random_mesh.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace phlux::test {
namespace {

using scene::Vec3;

RandomMesh tetrahedron() {
  return {
      {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

RandomMesh octahedron() {
  RandomMesh mesh{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, {}, {}};
  for (int octant = 0; octant < 8; ++octant) {
    std::array<int, 3> t{octant & 1 ? 3 : 0, octant & 2 ? 4 : 1, octant & 4 ? 5 : 2};
    if ((octant ^ octant >> 1 ^ octant >> 2) & 1) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

RandomMesh icosahedron() {
  const double golden = 1.618033988749895;
  RandomMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-golden, golden}) {
        Vec3 p(0.0);
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        mesh.positions.push_back(p);
      }
  const auto adjacent = [&](int i, int j) {
    return glm::distance(mesh.positions[static_cast<std::size_t>(i)],
                         mesh.positions[static_cast<std::size_t>(j)]) < 2.01;
  };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k)
        if (adjacent(i, j) && adjacent(j, k) && adjacent(i, k)) mesh.triangles.push_back({i, j, k});
  return mesh;
}

RandomMesh sheet(RandomNumbers& random) {
  constexpr int side = 3;
  RandomMesh mesh;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) mesh.positions.emplace_back(x - 1, y - 1, random.uniform(-0.3, 0.3));
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      const int corner = y * side + x;
      mesh.triangles.push_back({corner, corner + 1, corner + side});
      mesh.triangles.push_back({corner + 1, corner + side + 1, corner + side});
    }
  return mesh;
}

Vec3 in_ball(RandomNumbers& random) {
  while (true) {
    const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (glm::dot(v, v) < 1) return v;
  }
}

// Counter-clockwise as seen from outside.
void face_outwards(RandomMesh& mesh) {
  for (std::array<int, 3>& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[static_cast<std::size_t>(t[0])],
               &b = mesh.positions[static_cast<std::size_t>(t[1])],
               &c = mesh.positions[static_cast<std::size_t>(t[2])];
    if (glm::dot(glm::cross(b - a, c - a), a + b + c) < 0) std::swap(t[1], t[2]);
  }
}

class Bytes {
public:
  explicit Bytes(bool little_endian) : swap_(little_endian != (std::endian::native == std::endian::little)) {}
  template<class T>
  void add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (swap_) std::reverse(std::begin(bytes), std::end(bytes));
    text.append(bytes, sizeof(T));
  }
  std::string text;

private:
  bool swap_;
};

std::string ply_header(const RandomMesh& mesh, const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "{}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, mesh.positions.size(),
      mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
      mesh.triangles.size());
}

} // namespace

RandomMesh random_mesh(MeshShape shape, bool with_normals, RandomNumbers& random) {
  RandomMesh mesh = shape == MeshShape::tetrahedron   ? tetrahedron()
                    : shape == MeshShape::octahedron  ? octahedron()
                    : shape == MeshShape::icosahedron ? icosahedron()
                                                      : sheet(random);
  const bool closed = shape != MeshShape::sheet;
  for (Vec3& p : mesh.positions) p = (closed ? glm::normalize(p) : p) + 0.15 * in_ball(random);
  if (closed) face_outwards(mesh);
  for (const Vec3& p : mesh.positions)
    if (with_normals)
      mesh.normals.push_back(
          glm::normalize((closed ? glm::normalize(p) : Vec3(0, 0, 1)) + 0.5 * in_ball(random)));
  return mesh;
}

RandomMesh random_room(RandomNumbers& random) {
  RandomMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 lean = 0.6 * in_ball(random);
      const int first = static_cast<int>(mesh.positions.size());
      for (const double a : {-side, side})
        for (const double b : {-1.0, 1.0}) {
          Vec3 p(0.0), inwards(0.0);
          p[axis] = side;
          p[(axis + 1) % 3] = a;
          p[(axis + 2) % 3] = b;
          inwards[axis] = -side;
          mesh.positions.push_back(p);
          mesh.normals.push_back(glm::normalize(inwards + lean));
        }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first + 1, first + 3, first + 2});
    }
  return mesh;
}

std::string obj_file(const RandomMesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.positions) text += fmt::format("v {:.7g} {:.7g} {:.7g}\n", p.x, p.y, p.z);
  for (const Vec3& n : mesh.normals) text += fmt::format("vn {:.7g} {:.7g} {:.7g}\n", n.x, n.y, n.z);
  for (const auto& t : mesh.triangles)
    text += mesh.normals.empty()
                ? fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1)
                : fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string ply_file(const RandomMesh& mesh, PlyFormat format) {
  if (format == PlyFormat::ascii) {
    std::string text = ply_header(mesh, "ascii");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      text +=
          fmt::format("{:.7g} {:.7g} {:.7g}", mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z);
      if (!mesh.normals.empty())
        text += fmt::format(" {:.7g} {:.7g} {:.7g}", mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z);
      text += '\n';
    }
    for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
  }
  const bool little = format == PlyFormat::little_endian;
  Bytes bytes(little);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (int k = 0; k < 3; ++k) bytes.add(static_cast<float>(mesh.positions[i][k]));
    for (int k = 0; k < 3 && !mesh.normals.empty(); ++k) bytes.add(static_cast<float>(mesh.normals[i][k]));
  }
  for (const auto& t : mesh.triangles) {
    bytes.add(std::uint8_t{3});
    for (const int corner : t) bytes.add(static_cast<std::int32_t>(corner));
  }
  return ply_header(mesh, little ? "binary_little_endian" : "binary_big_endian") + bytes.text;
}

} // namespace phlux::test
