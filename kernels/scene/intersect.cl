// Intersection of rays with flat primitives and spheres. Each test can be used in two ways: many rays with one
// primitive, whose values are the same in every lane, or one ray with many primitives.
#ifndef PHLUX_INTERSECT_CL
#define PHLUX_INTERSECT_CL

#include "math/vectors.h"
#include "scene/scene_data.h"

typedef struct {
  Vec3 origin, direction; // unit direction
} Ray;

static inline Ray select_ray(Mask m, Ray yes, Ray no) {
  const Ray ray = {vec_select(m, yes.origin, no.origin), vec_select(m, yes.direction, no.direction)};
  return ray;
}

// The closest hit so far, at distance `numerator` / `denominator`, which are divided only once, at the end.
typedef struct {
  Real numerator, denominator; // denominator > 0
  Int primitive;               // -1: none
} ClosestHit;

typedef struct {
  Real distance; // along the unit direction; undefined without a primitive
  Int primitive; // -1: none
} Hit;

static inline ClosestHit no_hit_within(Real distance) {
  ClosestHit hit;
  hit.numerator = distance;
  hit.denominator = (Real)(1.0f);
  hit.primitive = (Int)(-1);
  return hit;
}

// ---- Flat primitives

typedef struct {
  Vec3 origin, edge_v, minus_u, normal; // scaled as enum PlanarValues says
} Planar;

// Intersection with the plane: u, v and the distance, each multiplied by facing = |cosine to the normal|. By Cramer's
// rule, relative to the origin of the primitive (Moller and Trumbore 1997, but with a stored normal).
typedef struct {
  Real u, v, distance, facing;
} PlaneCrossing;

static inline PlaneCrossing cross_plane(Ray ray, Planar p) {
  const Vec3 from_origin = vec_sub(ray.origin, p.origin);
  const Vec3 moment = vec_cross(from_origin, ray.direction);
  const Real towards = -vec_dot(p.normal, ray.direction); // > 0: the ray hits the front
  PlaneCrossing c;
  c.facing = fabs(towards);
  c.u = times_sign(vec_dot(moment, p.edge_v), towards);
  c.v = times_sign(vec_dot(moment, p.minus_u), towards);
  c.distance = times_sign(vec_dot(p.normal, from_origin), towards);
  return c;
}

static inline Mask in_triangle(PlaneCrossing c) { return (c.u >= 0.0f) & (c.v >= 0.0f) & (c.u + c.v <= c.facing); }
static inline Mask in_parallelogram(PlaneCrossing c) { return (fabs(c.u) <= c.facing) & (fabs(c.v) <= c.facing); }
static inline Mask in_ellipse(PlaneCrossing c) { return fma(c.u, c.u, c.v * c.v) <= c.facing * c.facing; }

// Lanes in which the intersection is in front of the origin and closer than `hit`.
static inline Mask crosses_before(PlaneCrossing c, ClosestHit hit) {
  return (c.distance > 0.0f) & (c.distance * hit.denominator < hit.numerator * c.facing);
}

// ---- Spheres

typedef struct {
  Vec3 center;
  Real radius;
} SphereShape;

// The smallest distance > 0 to the sphere along the ray, or 0. The discriminant is computed from the vector of closest
// approach, and the second root from the product of the roots, which is accurate for large spheres and near the surface
// (Haines, Gunther, Akenine-Moller, Ray Tracing Gems, 2019, chapter 7).
static inline Real cross_sphere(Ray ray, SphereShape s) {
  const Vec3 to_origin = vec_sub(ray.origin, s.center);
  const Real b = -vec_dot(to_origin, ray.direction);
  const Vec3 closest = vec_along(to_origin, b, ray.direction);
  const Real radius2 = s.radius * s.radius;
  const Real discriminant = radius2 - vec_dot(closest, closest);
  const Real c = vec_dot(to_origin, to_origin) - radius2;
  const Real q = b + times_sign(sqrt(larger(discriminant, (Real)(0.0f))), b);
  const Real other = c / q;
  const Real near = smaller(q, other), far = larger(q, other);
  const Real distance = near > 0.0f ? near : far;
  return ((discriminant >= 0.0f) & (distance > 0.0f)) ? distance : (Real)(0.0f);
}

#endif
