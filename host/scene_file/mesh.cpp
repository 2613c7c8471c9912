#include "scene_file/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "input_file.h"

namespace phlux::scene_file {

namespace {

using scene::Mesh;
using scene::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

/// Rounding error of single precision: with a smaller sine at a corner, a triangle is degenerate.
constexpr double least_sine = std::numeric_limits<float>::epsilon() / 2.0;

bool representable(const Vec3& p) {
  constexpr double most = std::numeric_limits<float>::max();
  return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most; // false for NaN
}

/// Twice the area, along the front side's normal.
Vec3 area_vector(const Mesh& mesh, const Triangle& t) {
  const Vec3& p = mesh.positions[t[0]];
  return glm::cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p);
}

/// Whether the triangle has an area after rounding its positions to single precision.
bool has_area(const Mesh& mesh, const Triangle& t) {
  const Vec3 p(glm::vec3(mesh.positions[t[0]]));
  const Vec3 u = Vec3(glm::vec3(mesh.positions[t[1]])) - p, v = Vec3(glm::vec3(mesh.positions[t[2]])) - p;
  return glm::length(glm::cross(u, v)) > least_sine * glm::length(u) * glm::length(v);
}

void transform_positions(Mesh& mesh, const glm::dmat4& to_world, const Location& file) {
  for (Vec3& p : mesh.positions) {
    p = Vec3(to_world * glm::dvec4(p, 1.0));
    if (!representable(p))
      fail(file, "a vertex is outside the range of single precision",
           "a smaller mesh, or a transform to the world that scales it less");
  }
}

glm::dmat3 normal_matrix(const glm::dmat4& to_world) {
  return glm::transpose(glm::inverse(glm::dmat3(to_world)));
}

void transform(Mesh& mesh, const glm::dmat4& to_world, const Location& file) {
  transform_positions(mesh, to_world, file);
  const glm::dmat3 normal_to_world = normal_matrix(to_world);
  for (glm::vec3& n : mesh.normals) {
    const Vec3 world = normal_to_world * Vec3(n);
    const double length = glm::length(world);
    n = length > 0.0 ? glm::vec3(world / length) : glm::vec3(0.0f);
  }
}

/// Mitsuba transforms the normal of a point of an instance, that of its triangle or the interpolated one.
void transform_instance(Mesh& mesh, const glm::dmat4& to_world, const Location& file) {
  transform_positions(mesh, to_world, file);
  const glm::dmat3 normal_to_world = normal_matrix(to_world);
  double longest = 0.0;
  for (const glm::vec3& n : mesh.normals) longest = std::max(longest, glm::length(normal_to_world * Vec3(n)));
  for (glm::vec3& n : mesh.normals) n = glm::vec3(normal_to_world * Vec3(n) / longest);
  if (glm::determinant(normal_to_world) < 0.0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// Removes triangles without area and returns their number.
std::size_t remove_flat(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [&mesh](const Triangle& t) { return !has_area(mesh, t); });
}

/// Reverses triangles whose front is not on the side of their vertices' normals.
void orient_by_normals(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) {
    const glm::vec3 sum = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
    if (glm::dot(area_vector(mesh, t), Vec3(sum)) < 0.0) std::swap(t[1], t[2]);
  }
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Replaces zero normals by the mean of the adjacent triangles' normals, weighted by their angles at the
/// vertex (Thuermer and Wuethrich 1998).
void compute_missing_normals(Mesh& mesh) {
  mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
  const auto missing = [&mesh](std::size_t i) { return mesh.normals[i] == glm::vec3(0.0f); };
  std::vector<bool> computed(mesh.positions.size());
  for (std::size_t i = 0; i < computed.size(); ++i) computed[i] = missing(i);
  if (std::ranges::find(computed, true) == computed.end()) return;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 normal = glm::normalize(area_vector(mesh, t));
    for (std::size_t k = 0; k < 3; ++k) {
      if (!computed[t[k]]) continue;
      const Vec3& p = mesh.positions[t[k]];
      const double angle =
          angle_between(mesh.positions[t[(k + 1) % 3]] - p, mesh.positions[t[(k + 2) % 3]] - p);
      mesh.normals[t[k]] += glm::vec3(normal * angle);
    }
  }
  for (std::size_t i = 0; i < computed.size(); ++i)
    if (computed[i] && !missing(i)) mesh.normals[i] = glm::vec3(glm::normalize(Vec3(mesh.normals[i])));
  for (const Triangle& t : mesh.triangles) // if the sum cancels, the normal of any adjacent triangle
    for (const auto i : t)
      if (missing(i)) mesh.normals[i] = glm::vec3(glm::normalize(area_vector(mesh, t)));
  for (glm::vec3& n : mesh.normals)
    if (n == glm::vec3(0.0f)) n = {0.0f, 0.0f, 1.0f}; // of vertices that no triangle uses
}

void flip(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  for (glm::vec3& n : mesh.normals) n = -n;
}

} // namespace

std::string read_bytes(const MeshRequest& request) {
  std::optional<std::string> bytes = bytes_of(request.file);
  if (!bytes)
    fail(request.named_at, "mesh file '" + request.file.string() + "' cannot be read",
         "an existing file, named relative to the scene's folder");
  if (is_utf16(*bytes))
    fail(request.named_at, "mesh file '" + request.file.string() + "' is in UTF-16", "UTF-8");
  remove_byte_order_mark(*bytes);
  return std::move(*bytes);
}

scene::Mesh finish_mesh(MeshPart part, const MeshRequest& request) {
  const Location file{std::make_shared<const std::string>(request.file.string()), 0};
  const bool no_normals = request.face_normals || part.face_normals;
  Mesh& mesh = part.mesh;
  if (mesh.triangles.empty() && part.incomplete == 0)
    fail(file, "the mesh has no triangles", "at least one face");
  if (no_normals) mesh.normals.clear();
  transform(mesh, request.to_world, file);
  auto flat = remove_flat(mesh);
  request.warnings->add_number(file, part.incomplete, "faces with fewer than three corners are dropped");
  if (!mesh.normals.empty()) orient_by_normals(mesh);
  if (!no_normals) compute_missing_normals(mesh);
  if (request.flip_normals) flip(mesh);
  if (request.instance) {
    transform_instance(mesh, *request.instance, file);
    flat += remove_flat(mesh);
  }
  request.warnings->add_number(file, flat, "zero-area triangles are dropped");
  return std::move(mesh);
}

} // namespace phlux::scene_file
