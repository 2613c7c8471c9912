// What a ray finds: the point, its frame, its sides, and how far to step off it.
#ifndef PHLUX_SURFACE_CL
#define PHLUX_SURFACE_CL

#include "frames.h"
#include "intersect.cl"
#include "scene.cl"
#include "traverse.cl"

typedef struct {
  Vec3 position; // on the primitive, to a few ulp
  Vec3 normal;   // geometric, unit, on the side that the ray came from
  Frame frame;   // shading frame on that side; its z is the normal of interpolation where there is one
  Real error;    // bounds the rounding error of `position` and of a ray's crossing near it
  Mask front;    // that side is the front
  Int material, light;
} SurfacePoint;

// A point's coordinates and the arithmetic of the tests that meet it again are right to a few half units in the last
// place of the largest number that enters them; 16 such units keep a ray from meeting the surface it leaves.
#define ERROR_UNITS (16.0f * REAL_HALF_ULP)

#ifdef PHLUX_PLANARS
// Where value 0 of a flat primitive is, and value k from there (scene_data.h).
#ifdef PRIMITIVES_AT_HAND
static inline Int planar_words(Int primitive) { return primitive; }
static inline Real planar_value(const Scene* scene, Int words, int value) {
  return permute_real(scene->planar_members[value], words);
}
#else
static inline Int planar_words(Int primitive) {
  return primitive * PLANAR_FLOATS - (primitive & (SCENE_BLOCK - 1)) * (PLANAR_FLOATS - 1);
}
static inline Real planar_value(const Scene* scene, Int words, int value) {
  return gather_scalar(scene->planars, words + value * SCENE_BLOCK);
}
#endif
static inline Vec3 gather_planar(const Scene* scene, Int words, int value) {
  return vec3(planar_value(scene, words, value), planar_value(scene, words, value + 1),
              planar_value(scene, words, value + 2));
}
#endif

#ifdef PHLUX_SPHERES
static inline Real sphere_value(const Scene* scene, Int sphere, int value) {
#ifdef PRIMITIVES_AT_HAND
  return permute_real(scene->sphere_members[value], sphere);
#else
  const Int words = sphere * SPHERE_FLOATS - (sphere & (SCENE_BLOCK - 1)) * (SPHERE_FLOATS - 1);
  return gather_scalar(scene->spheres, words + value * SCENE_BLOCK);
#endif
}
static inline SphereShape gather_sphere(const Scene* scene, Int sphere) {
  SphereShape s;
  s.center = vec3(sphere_value(scene, sphere, 0), sphere_value(scene, sphere, 1), sphere_value(scene, sphere, 2));
  s.radius = sphere_value(scene, sphere, SPHERE_RADIUS);
  return s;
}
#endif

#ifdef PHLUX_SMOOTH_NORMALS
// The normal interpolated from a triangle's corners; `flat` where it has none or where they cancel.
static inline Vec3 interpolated_normal(const Scene* scene, Int primitive, Real u, Real v, Vec3 flat) {
  const Int a = gather_int(scene->corners, primitive * 3);
  const Int b = gather_int(scene->corners, primitive * 3 + 1), c = gather_int(scene->corners, primitive * 3 + 2);
  const Mask smooth = a >= 0;
  Vec3 sum = vec_all((Real)(0.0f));
  const Int corner[3] = {max(a, (Int)(0)), max(b, (Int)(0)), max(c, (Int)(0))};
  const Real weight[3] = {1.0f - u - v, u, v};
  for (int i = 0; i < 3; ++i)
    sum = vec_along(sum, weight[i],
                    vec3(gather_real(scene->vertex_normals, corner[i] * 3),
                         gather_real(scene->vertex_normals, corner[i] * 3 + 1),
                         gather_real(scene->vertex_normals, corner[i] * 3 + 2)));
  return vec_select(smooth & (vec_dot(sum, sum) > 0.0f), vec_normalize(sum), flat);
}
#endif

// The point that `hit` found along `ray`; lanes without a hit hold a valid but meaningless point.
static inline SurfacePoint surface_point(const Scene* scene, Ray ray, Hit hit) {
  SurfacePoint s;
  const Int primitive = max(hit.primitive, (Int)(0));
  const Vec3 seen = vec_along(ray.origin, hit.distance, ray.direction);
  Vec3 outward, shading;
#if defined(PHLUX_ANISOTROPIC)
  Vec3 tangent;
#endif
#ifdef PHLUX_PLANARS
#ifdef PHLUX_SPHERES
  const Int planar = min(primitive, (Int)(max(scene->first_sphere - 1, 0)));
#else
  const Int planar = primitive;
#endif
  {
    const Int words = planar_words(planar);
    outward = gather_planar(scene, words, PLANAR_NORMAL);
    const Vec3 from_origin = vec_sub(seen, gather_planar(scene, words, PLANAR_ORIGIN));
    s.position = vec_along(seen, -vec_dot(outward, from_origin), outward);
    s.error = ERROR_UNITS * (vec_largest(s.position) + vec_largest(from_origin));
    shading = outward;
#ifdef PHLUX_SMOOTH_NORMALS
    const Real u = vec_dot(outward, vec_cross(from_origin, gather_planar(scene, words, PLANAR_EDGE_V)));
    const Real v = vec_dot(outward, vec_cross(from_origin, gather_planar(scene, words, PLANAR_MINUS_U)));
    shading = interpolated_normal(scene, planar, u, v, outward);
#endif
#ifdef PHLUX_ANISOTROPIC
    tangent = vec_scale((Real)(-1.0f), gather_planar(scene, words, PLANAR_MINUS_U));
#endif
  }
#endif
#ifdef PHLUX_SPHERES
  {
#ifdef PHLUX_PLANARS
    const Mask round = primitive >= scene->first_sphere;
#endif
    const SphereShape sphere = gather_sphere(scene, max(primitive - scene->first_sphere, (Int)(0)));
    const Vec3 unit = vec_normalize(vec_sub(seen, sphere.center));
    const Mask inward = PRIMITIVE_INT(scene, primitive, region) != 0;
    const Vec3 front = vec_select(inward, vec_scale((Real)(-1.0f), unit), unit);
    const Vec3 on_sphere = vec_along(sphere.center, sphere.radius, unit);
    const Real error = ERROR_UNITS * (vec_largest(sphere.center) + sphere.radius);
#ifdef PHLUX_PLANARS
    s.position = vec_select(round, on_sphere, s.position);
    s.error = round ? error : s.error;
    outward = vec_select(round, front, outward);
    shading = vec_select(round, front, shading);
#else
    s.position = on_sphere;
    s.error = error;
    outward = shading = front;
#endif
#ifdef PHLUX_ANISOTROPIC
    const Vec3 around = vec3(-unit.y, unit.x, (Real)(0.0f)); // d position / d phi about the z axis
#ifdef PHLUX_PLANARS
    tangent = vec_select(round, around, tangent);
#else
    tangent = around;
#endif
#endif
  }
#endif
  s.front = vec_dot(outward, ray.direction) < 0.0f;
  s.normal = vec_select(s.front, outward, vec_scale((Real)(-1.0f), outward));
  shading = vec_select(s.front, shading, vec_scale((Real)(-1.0f), shading));
#ifdef PHLUX_ANISOTROPIC
  s.frame = frame_along(shading, tangent);
#else
  s.frame = frame_about(shading);
#endif
  s.material = PRIMITIVE_INT(scene, primitive, material);
  s.light = PRIMITIVE_INT(scene, primitive, light);
  return s;
}

// A point of a surface for a ray to start or end at: what a SurfacePoint, a light's point and a stored vertex share.
typedef struct {
  Vec3 position, normal; // as SurfacePoint's
  Real error;
} Place;

static inline Place place_of(SurfacePoint point) {
  Place place;
  place.position = point.position;
  place.normal = point.normal;
  place.error = point.error;
  return place;
}

// Where a ray along `direction` starts, just off the surface on the side that it leaves to.
static inline Vec3 step_off(Vec3 position, Vec3 normal, Real error, Vec3 direction) {
  return vec_along(position, times_sign(error, vec_dot(normal, direction)), normal);
}

// The ray from a surface to a point in space, and the distance before which it must be free.
static inline Ray ray_to_point(Place from, Vec3 to, Real* distance) {
  Ray ray;
  ray.origin = step_off(from.position, from.normal, from.error, vec_sub(to, from.position));
  const Vec3 way = vec_sub(to, ray.origin);
  *distance = sqrt(vec_dot(way, way));
  ray.direction = vec_scale((Real)(1.0f) / *distance, way);
  return ray;
}

// The same to a point of a surface whose normal faces the start: it ends short by what the surface's crossing may be
// wrong as seen from there.
static inline Ray ray_between(Place from, Place to, Real* distance) {
  const Real reach = vec_largest(vec_sub(to.position, from.position));
  return ray_to_point(from, vec_along(to.position, to.error + ERROR_UNITS * reach, to.normal), distance);
}

#endif
