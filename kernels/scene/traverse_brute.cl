// Traversal for few primitives: the rays of all lanes are tested with each primitive in turn.
#ifndef PHLUX_TRAVERSE_BRUTE_CL
#define PHLUX_TRAVERSE_BRUTE_CL

#include "scene/intersect.cl"
#include "scene/scene.cl"

// A primitive, in every lane. Its values are `stride` apart.
static inline Planar planar_at(const __global Scalar* values, int stride) {
  Planar p;
  p.origin = broadcast_scalars(values + PLANAR_ORIGIN * stride, stride);
  p.edge_v = broadcast_scalars(values + PLANAR_EDGE_V * stride, stride);
  p.minus_u = broadcast_scalars(values + PLANAR_MINUS_U * stride, stride);
  p.normal = broadcast_scalars(values + PLANAR_NORMAL * stride, stride);
  return p;
}

static inline SphereShape sphere_at(const __global Scalar* values, int stride) {
  SphereShape s;
  s.center = broadcast_scalars(values + SPHERE_CENTER * stride, stride);
  s.radius = (Real)(values[SPHERE_RADIUS * stride]);
  return s;
}

#define CLOSEST_OF(inside, first, end)                                                                                 \
  for (int i = (first); i < (end); ++i) {                                                                              \
    const PlaneCrossing c = cross_plane(ray, planar_at(scene->planars + i * PLANAR_FLOATS, 1));                        \
    const Mask closer = inside(c) & crosses_before(c, closest);                                                        \
    closest.numerator = closer ? c.distance : closest.numerator;                                                       \
    closest.denominator = closer ? c.facing : closest.denominator;                                                     \
    closest.primitive = closer ? (Int)(i) : closest.primitive;                                                         \
  }

#define ANY_OF(inside, first, end)                                                                                     \
  for (int i = (first); i < (end) && !all_lanes(blocked); ++i) {                                                       \
    const PlaneCrossing c = cross_plane(ray, planar_at(scene->planars + i * PLANAR_FLOATS, 1));                        \
    blocked |= inside(c) & crosses_before(c, limit);                                                                   \
  }

static inline Hit brute_intersect(const Scene* scene, Ray ray) {
  ClosestHit closest = no_hit_within((Real)(INFINITY));
  if (HAS_TRIANGLES) CLOSEST_OF(in_triangle, 0, scene->triangle_end)
  if (HAS_PARALLELOGRAMS) CLOSEST_OF(in_parallelogram, scene->triangle_end, scene->parallelogram_end)
  if (HAS_ELLIPSES) CLOSEST_OF(in_ellipse, scene->parallelogram_end, scene->ellipse_end)
  if (HAS_SPHERES) {
    for (int i = 0; i < scene->sphere_count; ++i) {
      const Real distance = cross_sphere(ray, sphere_at(scene->spheres + i * SPHERE_FLOATS, 1));
      const Mask closer = (distance > 0.0f) & (distance * closest.denominator < closest.numerator);
      closest.numerator = closer ? distance : closest.numerator;
      closest.denominator = closer ? (Real)(1.0f) : closest.denominator;
      closest.primitive = closer ? (Int)(scene->first_sphere + i) : closest.primitive;
    }
  }
  Hit hit;
  hit.distance = closest.numerator / closest.denominator;
  hit.primitive = closest.primitive;
  return hit;
}

static inline Mask brute_occluded(const Scene* scene, Ray ray, Real distance, Mask asking) {
  const ClosestHit limit = no_hit_within(distance);
  Mask blocked = !asking;
  if (HAS_TRIANGLES) ANY_OF(in_triangle, 0, scene->triangle_end)
  if (HAS_PARALLELOGRAMS) ANY_OF(in_parallelogram, scene->triangle_end, scene->parallelogram_end)
  if (HAS_ELLIPSES) ANY_OF(in_ellipse, scene->parallelogram_end, scene->ellipse_end)
  if (HAS_SPHERES) {
    for (int i = 0; i < scene->sphere_count && !all_lanes(blocked); ++i) {
      const Real crossing = cross_sphere(ray, sphere_at(scene->spheres + i * SPHERE_FLOATS, 1));
      blocked |= (crossing > 0.0f) & (crossing < distance);
    }
  }
  return blocked & asking;
}

#endif
