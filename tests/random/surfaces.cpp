#include "random/surfaces.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace phlux::test {
namespace {

using scene::Vec3;

Vec3 vector_at(const std::vector<double>& values, std::size_t index) {
  return {values[index], values[index + 1], values[index + 2]};
}

bool inside(int region, double u, double v) {
  switch (region) {
  case REGION_TRIANGLE:
    return u >= 0 && v >= 0 && u + v <= 1;
  case REGION_PARALLELOGRAM:
    return std::max(std::abs(u), std::abs(v)) <= 1;
  case REGION_ELLIPSE:
    return u * u + v * v <= 1;
  default:
    return false;
  }
}

} // namespace

std::optional<Surfaces::Hit> Surfaces::planar_hit(std::size_t primitive, const Vec3& origin,
                                                  const Vec3& direction) const {
  const std::size_t base = primitive * PLANAR_FLOATS;
  const std::vector<double>& values = geometry_.double_planars;
  const Vec3 normal = vector_at(values, base + PLANAR_NORMAL);
  const Vec3 from = origin - vector_at(values, base + PLANAR_ORIGIN);
  const double cosine = glm::dot(normal, direction), distance = -glm::dot(normal, from) / cosine;
  if (!(distance > 0)) return {};
  const Vec3 place = from + distance * direction;
  const double u = glm::dot(normal, glm::cross(place, vector_at(values, base + PLANAR_EDGE_V)));
  const double v = glm::dot(normal, glm::cross(place, vector_at(values, base + PLANAR_MINUS_U)));
  if (!inside(geometry_.primitives[primitive].region, u, v)) return {};
  return Hit{distance, std::abs(cosine)};
}

std::optional<Surfaces::Hit> Surfaces::sphere_hit(std::size_t sphere, const Vec3& origin,
                                                  const Vec3& direction) const {
  const std::size_t base = sphere * SPHERE_FLOATS;
  const Vec3 from = origin - vector_at(geometry_.double_spheres, base + SPHERE_CENTER);
  const double radius = geometry_.double_spheres[base + SPHERE_RADIUS], b = glm::dot(from, direction);
  const double square = b * b - glm::dot(from, from) + radius * radius;
  if (square < 0) return {};
  for (const double distance : {-b - std::sqrt(square), -b + std::sqrt(square)})
    if (distance > 0) return Hit{distance, std::sqrt(square) / radius};
  return {};
}

std::optional<Surfaces::Hit> Surfaces::first_hit(const Vec3& origin, const Vec3& direction) const {
  std::optional<Hit> nearest;
  const auto take = [&](const std::optional<Hit>& hit) {
    if (hit && (!nearest || hit->distance < nearest->distance)) nearest = hit;
  };
  const auto first_sphere = static_cast<std::size_t>(geometry_.first_sphere);
  for (std::size_t i = 0; i < first_sphere; ++i) take(planar_hit(i, origin, direction));
  for (std::size_t i = 0; first_sphere + i < geometry_.primitives.size(); ++i)
    if (geometry_.primitives[first_sphere + i].region != REGION_NONE) take(sphere_hit(i, origin, direction));
  return nearest;
}

Surfaces::Place Surfaces::middle(int primitive) const {
  if (primitive >= geometry_.first_sphere) {
    const auto base = static_cast<std::size_t>(primitive - geometry_.first_sphere) * SPHERE_FLOATS;
    return {vector_at(geometry_.double_spheres, base + SPHERE_CENTER), Vec3(0.0)};
  }
  const std::size_t base = static_cast<std::size_t>(primitive) * PLANAR_FLOATS;
  const std::vector<double>& values = geometry_.double_planars;
  const Vec3 origin = vector_at(values, base + PLANAR_ORIGIN),
             normal = vector_at(values, base + PLANAR_NORMAL);
  if (geometry_.primitives[static_cast<std::size_t>(primitive)].region != REGION_TRIANGLE)
    return {origin, normal};
  // Edges are stored divided by the length of their cross product.
  const Vec3 v = vector_at(values, base + PLANAR_EDGE_V), u = -vector_at(values, base + PLANAR_MINUS_U);
  return {origin + (u + v) / (3 * glm::length(glm::cross(u, v))), normal};
}

} // namespace phlux::test
