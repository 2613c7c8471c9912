#include "accel/primitive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>

namespace phlux::accel {
namespace {

using scene::Vec3;

// Largest relative error of rounding a double to float.
constexpr float half_ulp = std::numeric_limits<float>::epsilon() / 2;

Vec3 rounded(const Vec3& v) {
  return Vec3(glm::vec3(v));
}

// A planar primitive: a vertex (or the centre) and two edges, relative to the geometry's origin. For tables
// of float, vertices are rounded before edges are computed, so that neighbouring triangles still share them.
struct Flat {
  Vec3 origin, edge_u, edge_v;
  int region;
  scene::Surface surface;
};

Flat flat(const scene::Scene& scene, const Vec3& origin, Reference reference, bool in_double = false) {
  const auto about_origin = [&](const Vec3& v) { return in_double ? v - origin : rounded(v - origin); };
  if (reference.kind == Reference::Kind::patch) {
    const scene::Patch& patch = scene.patches[reference.object];
    const bool ellipse = patch.region == scene::Patch::Region::ellipse;
    return {about_origin(patch.origin), patch.edge_u, patch.edge_v,
            ellipse ? REGION_ELLIPSE : REGION_PARALLELOGRAM, patch.surface};
  }
  const scene::Mesh& mesh = scene.meshes[reference.object];
  const auto& [a, b, c] = mesh.triangles[reference.element];
  const Vec3 p0 = about_origin(mesh.positions[a]);
  return {p0, about_origin(mesh.positions[b]) - p0, about_origin(mesh.positions[c]) - p0, REGION_TRIANGLE,
          mesh.surface};
}

void grow(Box& box, const Vec3& low, const Vec3& high) {
  for (int axis = 0; axis < 3; ++axis) {
    // Rounded outwards by twice the largest error of rounding to float.
    const double margin = 4.0 * half_ulp * std::max(std::abs(low[axis]), std::abs(high[axis]));
    const auto i = static_cast<std::size_t>(axis);
    box.low[i] = std::min(box.low[i], static_cast<float>(low[axis] - margin));
    box.high[i] = std::max(box.high[i], static_cast<float>(high[axis] + margin));
  }
}

Box empty_box() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

// Half the extent of a parallelogram or ellipse along each axis.
Vec3 half_extent(const Flat& f) {
  if (f.region == REGION_PARALLELOGRAM) return glm::abs(f.edge_u) + glm::abs(f.edge_v);
  return glm::sqrt(f.edge_u * f.edge_u + f.edge_v * f.edge_v);
}

// Writes the values of primitive `index` into a table of blocks, which grows by whole blocks.
template<typename T, std::size_t count>
void write_values(std::vector<T>& table, std::size_t block, std::size_t index,
                  const std::array<double, count>& values) {
  const std::size_t slot = index % block;
  if (slot == 0) table.resize(table.size() + count * block, T{0});
  T* first = table.data() + (index / block) * count * block + slot;
  for (std::size_t k = 0; k < count; ++k) first[k * block] = static_cast<T>(values[k]);
}

struct Corners { // of the bounding box
  Vec3 low, high;
};

Corners corners(const Flat& f) {
  if (f.region != REGION_TRIANGLE) return {f.origin - half_extent(f), f.origin + half_extent(f)};
  const Vec3 p1 = f.origin + f.edge_u, p2 = f.origin + f.edge_v;
  return {glm::min(f.origin, glm::min(p1, p2)), glm::max(f.origin, glm::max(p1, p2))};
}

// Texture coordinates at a flat primitive's origin, and what they change by along its edges.
std::array<glm::dvec2, 3> uv_of(const scene::Scene& scene, Reference reference) {
  if (reference.kind == Reference::Kind::patch) return scene.patches[reference.object].uv;
  const scene::Mesh& mesh = scene.meshes[reference.object];
  if (mesh.texture_coordinates.empty()) return {glm::dvec2(0.0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
  const auto& [a, b, c] = mesh.triangles[reference.element];
  const glm::dvec2 at_a(mesh.texture_coordinates[a]);
  return {at_a, glm::dvec2(mesh.texture_coordinates[b]) - at_a,
          glm::dvec2(mesh.texture_coordinates[c]) - at_a};
}

// A unit vector perpendicular to n, the first that Mitsuba 3 gives a surface without texture coordinates
// (Duff et al. 2017).
Vec3 any_tangent(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z);
  return {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

// The direction of d position / d u; `is_mapped`: the primitive has texture coordinates of its own.
Vec3 tangent_of(const std::array<glm::dvec2, 3>& uv, bool is_mapped, const Vec3& edge_u, const Vec3& edge_v) {
  const Vec3 straight = uv[2].y * edge_u - uv[1].y * edge_v;
  const double determinant = uv[1].x * uv[2].y - uv[1].y * uv[2].x, length = glm::length(straight);
  if (is_mapped && determinant != 0 && length > 0)
    return straight * (std::copysign(1.0, determinant) / length);
  return any_tangent(glm::normalize(glm::cross(edge_u, edge_v)));
}

double area_of(int region, double cross_length) {
  switch (region) {
  case REGION_TRIANGLE:
    return cross_length / 2;
  case REGION_PARALLELOGRAM:
    return cross_length * 4;
  default:
    return cross_length * std::numbers::pi;
  }
}

} // namespace

Vec3 middle(const scene::Scene& scene) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low(infinity), high(-infinity);
  const auto include = [&](const Vec3& from, const Vec3& to) {
    low = glm::min(low, from);
    high = glm::max(high, to);
  };
  for (const scene::Mesh& mesh : scene.meshes)
    for (const Vec3& p : mesh.positions) include(p, p);
  for (const scene::Patch& patch : scene.patches) {
    const Vec3 half = glm::abs(patch.edge_u) + glm::abs(patch.edge_v);
    include(patch.origin - half, patch.origin + half);
  }
  for (const scene::Sphere& sphere : scene.spheres)
    include(sphere.center - sphere.radius, sphere.center + sphere.radius);
  return low.x <= high.x ? (low + high) * 0.5 : Vec3(0.0);
}

Box bounds(const scene::Scene& scene, const Vec3& origin, Reference reference) {
  Box box = empty_box();
  if (reference.kind == Reference::Kind::sphere) {
    const scene::Sphere& sphere = scene.spheres[reference.object];
    const Vec3 center = sphere.center - origin;
    grow(box, center - sphere.radius, center + sphere.radius);
    return box;
  }
  const auto [low, high] = corners(flat(scene, origin, reference));
  grow(box, low, high);
  return box;
}

bool has_area(const scene::Scene& scene, const Vec3& origin, Reference reference, bool in_double) {
  if (reference.kind == Reference::Kind::sphere) return true;
  const Flat f = flat(scene, origin, reference, in_double);
  const double length = glm::length(glm::cross(f.edge_u, f.edge_v));
  return length > 0.0 && std::isfinite(static_cast<float>(1.0 / length));
}

TableWriter::TableWriter(const scene::Scene& scene, Geometry& geometry)
    : scene_(scene), geometry_(geometry), with_uv_(scene::needs_uv(scene)) {
  std::size_t count = 0;
  for (const scene::Mesh& mesh : scene.meshes) {
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
      throw std::invalid_argument("a mesh has neither no normals nor one for each vertex");
    first_normal_of_mesh_.push_back(count);
    count += mesh.normals.size();
  }
  geometry.vertex_normals.reserve(count * 3);
  for (const scene::Mesh& mesh : scene.meshes)
    for (const glm::vec3& n : mesh.normals)
      geometry.vertex_normals.insert(geometry.vertex_normals.end(), {n.x, n.y, n.z});
}

void TableWriter::write_planar(const std::array<double, PLANAR_FLOATS>& values) {
  const auto block = static_cast<std::size_t>(geometry_.block);
  const std::size_t index = geometry_.primitives.size();
  if (geometry_.in_double)
    write_values(geometry_.double_planars, block, index, values);
  else
    write_values(geometry_.planars, block, index, values);
}

void TableWriter::write_sphere(const std::array<double, SPHERE_FLOATS>& values) {
  const auto block = static_cast<std::size_t>(geometry_.block);
  const std::size_t index = sphere_records_.size();
  if (geometry_.in_double)
    write_values(geometry_.double_spheres, block, index, values);
  else
    write_values(geometry_.spheres, block, index, values);
}

void TableWriter::add_corners(Reference reference) {
  if (geometry_.vertex_normals.empty()) return;
  const bool smooth =
      reference.kind == Reference::Kind::mesh && !scene_.meshes[reference.object].normals.empty();
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t corner = -1;
    if (smooth)
      corner = static_cast<std::int64_t>(first_normal_of_mesh_[reference.object]) +
               scene_.meshes[reference.object].triangles[reference.element][i];
    geometry_.corners.push_back(static_cast<int>(corner));
  }
}

void TableWriter::add_uv_map(Reference reference, const Vec3& edge_u, const Vec3& edge_v) {
  if (!with_uv_) return;
  const auto uv = uv_of(scene_, reference);
  const bool is_mapped = reference.kind == Reference::Kind::patch ||
                         !scene_.meshes[reference.object].texture_coordinates.empty();
  const Vec3 tangent = tangent_of(uv, is_mapped, edge_u, edge_v);
  for (const glm::dvec2& each : uv) // UV_ORIGIN, UV_PER_U, UV_PER_V
    for (int i = 0; i < 2; ++i) geometry_.uv_maps.push_back(static_cast<float>(each[i]));
  for (int i = 0; i < 3; ++i) geometry_.uv_maps.push_back(static_cast<float>(tangent[i])); // UV_TANGENT
}

void TableWriter::add_planar(Reference reference) {
  const Flat f = flat(scene_, geometry_.origin, reference, geometry_.in_double);
  const Vec3 cross = glm::cross(f.edge_u, f.edge_v);
  const double length = glm::length(cross);
  const Vec3 edge_v = f.edge_v / length, minus_u = -f.edge_u / length, normal = cross / length;
  std::array<double, PLANAR_FLOATS> values{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    values[PLANAR_ORIGIN + i] = f.origin[axis];
    values[PLANAR_EDGE_V + i] = edge_v[axis];
    values[PLANAR_MINUS_U + i] = minus_u[axis];
    values[PLANAR_NORMAL + i] = normal[axis];
  }
  write_planar(values);
  geometry_.primitives.push_back({f.surface.material, -1, f.region});
  geometry_.emitters.push_back(f.surface.area_emitter);
  if (f.surface.area_emitter >= 0) {
    const auto [low, high] = corners(f);
    geometry_.emitting.push_back({area_of(f.region, length), low, high, normal});
  }
  add_corners(reference);
  add_uv_map(reference, f.edge_u, f.edge_v);
  geometry_.has_triangles |= f.region == REGION_TRIANGLE;
  geometry_.has_parallelograms |= f.region == REGION_PARALLELOGRAM;
  geometry_.has_ellipses |= f.region == REGION_ELLIPSE;
  ++geometry_.primitive_count;
}

int TableWriter::finish_planar_block() {
  while (geometry_.primitives.size() % static_cast<std::size_t>(geometry_.block) != 0) {
    write_planar({}); // no ray intersects a primitive with normal 0
    geometry_.primitives.push_back({0, -1, REGION_NONE});
    geometry_.emitters.push_back(-1);
    if (!geometry_.vertex_normals.empty()) geometry_.corners.insert(geometry_.corners.end(), 3, -1);
    if (with_uv_) geometry_.uv_maps.resize(geometry_.primitives.size() * UV_FLOATS);
  }
  return static_cast<int>(geometry_.primitives.size());
}

void TableWriter::add_sphere(Reference reference) {
  const scene::Sphere& sphere = scene_.spheres[reference.object];
  const Vec3 center = sphere.center - geometry_.origin;
  write_sphere({center.x, center.y, center.z, sphere.radius});
  sphere_records_.push_back({sphere.surface.material, -1, sphere.front_is_inside ? 1 : 0});
  sphere_emitters_.push_back(sphere.surface.area_emitter);
  for (const Vec3& axis : sphere.axes) // UV_AXES
    for (int i = 0; with_uv_ && i < 3; ++i) sphere_uv_maps_.push_back(static_cast<float>(axis[i]));
  if (sphere.surface.area_emitter >= 0)
    emitting_spheres_.push_back({4.0 * std::numbers::pi * sphere.radius * sphere.radius,
                                 center - sphere.radius, center + sphere.radius, Vec3(0.0)});
  ++geometry_.primitive_count;
}

int TableWriter::finish_sphere_block() {
  const auto block = static_cast<std::size_t>(geometry_.block);
  while (sphere_records_.size() % block != 0) {
    // Padding: no ray hits a sphere of radius 0 this far away.
    write_sphere({1e18, 1e18, 1e18, 0.0});
    sphere_records_.push_back({0, -1, REGION_NONE});
    sphere_emitters_.push_back(-1);
    if (with_uv_) sphere_uv_maps_.resize(sphere_records_.size() * UV_FLOATS);
  }
  return static_cast<int>(sphere_records_.size());
}

void TableWriter::finish() {
  geometry_.first_sphere = static_cast<int>(geometry_.primitives.size());
  geometry_.sphere_count = static_cast<int>(sphere_records_.size());
  geometry_.primitives.insert(geometry_.primitives.end(), sphere_records_.begin(), sphere_records_.end());
  geometry_.emitters.insert(geometry_.emitters.end(), sphere_emitters_.begin(), sphere_emitters_.end());
  geometry_.uv_maps.insert(geometry_.uv_maps.end(), sphere_uv_maps_.begin(), sphere_uv_maps_.end());
  geometry_.emitting.insert(geometry_.emitting.end(), emitting_spheres_.begin(), emitting_spheres_.end());
}

} // namespace phlux::accel
