// The point of a surface that a ray hits: position, shading frame and sides; rays that start or end at surfaces.
#ifndef PHLUX_SURFACE_CL
#define PHLUX_SURFACE_CL

#include "math/frames.h"
#include "scene/intersect.cl"
#include "scene/scene.cl"
#include "scene/traverse.cl"
#include "scene/uv.cl"

typedef struct {
  Vec3 position;     // on the primitive, to a few ulp
  Vec3 normal;       // geometric, unit, on the side that the ray came from
  Frame frame;       // shading frame on the side from which the ray came; z is the interpolated normal if there is one
  Real error;        // bound on the rounding error of `position`, and of the intersection of a ray near it
  Mask front;        // the ray came from the front
  Mask shaded_front; // the ray came from the front, by the shading normal
  Mask transmits;    // the material transmits light
  Int material, light;
  TextureCoordinates uv; // HAS_TEXTURES; only if the material has a texture
} SurfacePoint;

// The rounding errors of a position, and of the test that could hit the same surface again, are a few half units in the
// last place of the largest coordinate. An offset of 16 half units prevents self-intersection.
#define ERROR_UNITS (16.0f * REAL_HALF_ULP)

// Primitives are stored one after another for brute force, and in blocks of LANES for the hierarchy.
#define SCENE_BLOCK (HAS_BVH ? LANES : 1)

// The index of value 0 of a flat primitive, and the offset of value k (scene_data.h).
static inline Int planar_words(Int primitive) {
  if (PRIMITIVES_IN_REGISTERS) return primitive;
  return primitive * PLANAR_FLOATS - (primitive & (SCENE_BLOCK - 1)) * (PLANAR_FLOATS - 1);
}
static inline Real planar_value(const Scene* scene, Int words, int value) {
  if (PRIMITIVES_IN_REGISTERS) return permute_real(scene->planar_members[value], words);
  return gather_scalar(scene->planars, words + value * SCENE_BLOCK);
}
static inline Vec3 gather_planar(const Scene* scene, Int words, int value) {
  return vec3(planar_value(scene, words, value), planar_value(scene, words, value + 1),
              planar_value(scene, words, value + 2));
}

static inline Real sphere_value(const Scene* scene, Int sphere, int value) {
  if (PRIMITIVES_IN_REGISTERS) return permute_real(scene->sphere_members[value], sphere);
  const Int words = sphere * SPHERE_FLOATS - (sphere & (SCENE_BLOCK - 1)) * (SPHERE_FLOATS - 1);
  return gather_scalar(scene->spheres, words + value * SCENE_BLOCK);
}
static inline SphereShape gather_sphere(const Scene* scene, Int sphere) {
  SphereShape s;
  s.center = vec3(sphere_value(scene, sphere, 0), sphere_value(scene, sphere, 1), sphere_value(scene, sphere, 2));
  s.radius = sphere_value(scene, sphere, SPHERE_RADIUS);
  return s;
}

// The interpolated normal of a triangle; `flat` if it has no normals or if they cancel.
static inline Vec3 interpolated_normal(const Scene* scene, Int primitive, Real u, Real v, Vec3 flat) {
  const Int a = gather_int(scene->corners, primitive * 3);
  const Int b = gather_int(scene->corners, primitive * 3 + 1), c = gather_int(scene->corners, primitive * 3 + 2);
  const Mask smooth = a >= 0;
  Vec3 sum = vec_all((Real)(0.0f));
  const Int corner[3] = {max(a, (Int)(0)), max(b, (Int)(0)), max(c, (Int)(0))};
  const Real weight[3] = {1.0f - u - v, u, v};
  for (int i = 0; i < 3; ++i) sum = vec_along(sum, weight[i], gather_vec(scene->vertex_normals, corner[i] * 3));
  return vec_select(smooth & (vec_dot(sum, sum) > 0.0f), vec_normalize(sum), flat);
}

// Geometry of a primitive at the point `seen`; normals are on the front.
typedef struct {
  Vec3 position, normal, shading_normal, tangent;
  Vec3 place; // flat: along edge_u and edge_v from the origin; sphere: the direction from the centre
  Real error;
} PrimitivePoint;

static inline PrimitivePoint planar_point(const Scene* scene, Int primitive, Vec3 seen) {
  PrimitivePoint p;
  const Int words = planar_words(primitive);
  p.normal = gather_planar(scene, words, PLANAR_NORMAL);
  const Vec3 from_origin = vec_sub(seen, gather_planar(scene, words, PLANAR_ORIGIN));
  p.position = vec_along(seen, -vec_dot(p.normal, from_origin), p.normal);
  p.error = ERROR_UNITS * (vec_largest(p.position) + vec_largest(from_origin));
  p.shading_normal = p.place = p.normal;
  if (HAS_SMOOTH_NORMALS | HAS_TEXTURES) {
    p.place.x = vec_dot(p.normal, vec_cross(from_origin, gather_planar(scene, words, PLANAR_EDGE_V)));
    p.place.y = vec_dot(p.normal, vec_cross(from_origin, gather_planar(scene, words, PLANAR_MINUS_U)));
  }
  if (HAS_SMOOTH_NORMALS) p.shading_normal = interpolated_normal(scene, primitive, p.place.x, p.place.y, p.normal);
  p.tangent = HAS_TANGENTS ? flat_tangent(scene, primitive, from_origin) : p.normal;
  return p;
}

static inline PrimitivePoint sphere_point(const Scene* scene, Int primitive, Vec3 seen) {
  PrimitivePoint p;
  const SphereShape sphere = gather_sphere(scene, max(primitive - scene->first_sphere, (Int)(0)));
  const Vec3 unit = vec_normalize(vec_sub(seen, sphere.center));
  const Mask front_inside = PRIMITIVE_INT(scene, primitive, region) != 0;
  p.normal = vec_select(front_inside, vec_scale((Real)(-1.0f), unit), unit);
  p.shading_normal = p.normal;
  p.position = vec_along(sphere.center, sphere.radius, unit);
  p.error = ERROR_UNITS * (vec_largest(sphere.center) + sphere.radius);
  p.place = unit;
  p.tangent = HAS_TANGENTS ? sphere_tangent(scene, primitive, unit) : unit;
  return p;
}

static inline PrimitivePoint primitive_point(const Scene* scene, Int primitive, Vec3 seen) {
  if (!HAS_PLANARS) return sphere_point(scene, primitive, seen);
  if (!HAS_SPHERES) return planar_point(scene, primitive, seen);
  const Mask is_sphere = primitive >= scene->first_sphere;
  const PrimitivePoint flat = planar_point(scene, min(primitive, (Int)(max(scene->first_sphere - 1, 0))), seen);
  const PrimitivePoint round = sphere_point(scene, primitive, seen);
  PrimitivePoint p;
  p.position = vec_select(is_sphere, round.position, flat.position);
  p.normal = vec_select(is_sphere, round.normal, flat.normal);
  p.shading_normal = vec_select(is_sphere, round.shading_normal, flat.shading_normal);
  p.tangent = vec_select(is_sphere, round.tangent, flat.tangent);
  p.place = vec_select(is_sphere, round.place, flat.place);
  p.error = is_sphere ? round.error : flat.error;
  return p;
}

// Texture coordinates of a point given by its place on its primitive, in the lanes of m.
static inline TextureCoordinates texture_coordinates(const Scene* scene, Int primitive, Vec3 place, Mask m) {
  TextureCoordinates at;
  at.u = at.v = (Real)(0.0f);
  if (!any_lane(m)) return at;
  const Mask round = m & (primitive >= scene->first_sphere);
  if (HAS_PLANARS) at = flat_uv(scene, primitive, place.x, place.y);
  if (HAS_SPHERES && any_lane(round)) {
    const TextureCoordinates on_sphere = sphere_uv(scene, primitive, place);
    at.u = round ? on_sphere.u : at.u;
    at.v = round ? on_sphere.v : at.v;
  }
  return at;
}

// The point of `hit` along `ray`. In lanes without a hit its indices are valid, but its position may not be finite.
static inline SurfacePoint surface_point(const Scene* scene, Ray ray, Hit hit) {
  const Int primitive = max(hit.primitive, (Int)(0));
  const PrimitivePoint p = primitive_point(scene, primitive, vec_along(ray.origin, hit.distance, ray.direction));
  SurfacePoint s;
  s.position = p.position;
  s.error = p.error;
  s.front = vec_dot(p.normal, ray.direction) < 0.0f;
  s.normal = vec_select(s.front, p.normal, vec_scale((Real)(-1.0f), p.normal));
  s.shaded_front = SIDES_BY_SHADING ? (Mask)(vec_dot(p.shading_normal, ray.direction) < 0.0f) : s.front;
  const Vec3 shading = vec_select(s.shaded_front, p.shading_normal, vec_scale((Real)(-1.0f), p.shading_normal));
  s.frame = HAS_TANGENTS ? frame_along(shading, p.tangent) : frame_about(shading);
  s.material = PRIMITIVE_INT(scene, primitive, material);
  s.transmits = NO_LANES;
  if (HAS_TRANSMISSION) s.transmits = (material_int(scene, s.material, MATERIAL_FLAGS) & MATERIAL_TRANSMITS) != 0;
  s.light = PRIMITIVE_INT(scene, primitive, light);
  s.uv.u = s.uv.v = (Real)(0.0f);
  if (HAS_TEXTURES) {
    const Mask textured = (material_int(scene, s.material, MATERIAL_FLAGS) & MATERIAL_TEXTURED) != 0;
    s.uv = texture_coordinates(scene, primitive, p.place, textured);
  }
  return s;
}

// A position on a surface at which a ray can start or end: that of a SurfacePoint, of a sampled point of a light, or of
// a stored vertex.
typedef struct {
  Vec3 position, normal; // as in SurfacePoint
  Real error;
} SurfacePosition;

static inline SurfacePosition surface_position(SurfacePoint point) {
  SurfacePosition p;
  p.position = point.position;
  p.normal = point.normal;
  p.error = point.error;
  return p;
}

// The origin of a ray along `direction`, offset by the rounding error to the side to which it leaves.
static inline Vec3 offset_origin(Vec3 position, Vec3 normal, Real error, Vec3 direction) {
  return vec_along(position, times_sign(error, vec_dot(normal, direction)), normal);
}

// The ray from a surface to a point in space, and the distance up to which it must be unoccluded.
static inline Ray ray_to_point(SurfacePosition from, Vec3 to, Real* distance) {
  Ray ray;
  ray.origin = offset_origin(from.position, from.normal, from.error, vec_sub(to, from.position));
  const Vec3 way = vec_sub(to, ray.origin);
  *distance = sqrt(vec_dot(way, way));
  ray.direction = vec_scale((Real)(1.0f) / *distance, way);
  return ray;
}

// The same to a point on a surface, whose normal faces the start unless HAS_SIGNED_COSINES. The distance is shorter by
// the error of the intersection with that surface along the ray.
static inline Ray ray_between(SurfacePosition from, SurfacePosition to, Real* distance) {
  const Real reach = vec_largest(vec_sub(to.position, from.position));
  Real short_by = to.error + ERROR_UNITS * reach;
  if (HAS_SIGNED_COSINES) short_by = times_sign(short_by, vec_dot(to.normal, vec_sub(from.position, to.position)));
  return ray_to_point(from, vec_along(to.position, short_by, to.normal), distance);
}

#endif
