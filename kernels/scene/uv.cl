// Texture coordinates and tangents of surface points, with the parametrizations of Mitsuba.
#ifndef PHLUX_UV_CL
#define PHLUX_UV_CL

#include "math/constants.h"
#include "scene/scene.cl"
#include "scene/textures.cl"

static inline Real uv_value(const Scene* scene, Int primitive, int value) {
  return gather_real(scene->uv_maps + value, primitive * UV_FLOATS);
}
static inline Vec3 uv_vector(const Scene* scene, Int primitive, int value) {
  return vec3(uv_value(scene, primitive, value), uv_value(scene, primitive, value + 1),
              uv_value(scene, primitive, value + 2));
}

// The angle of (x, y) from the x axis, in turns from 0 to 1.
static inline Real turns_of(Real x, Real y) {
  const Real turns = (0.5f * INV_PI) * atan2(y, x);
  return turns < 0.0f ? turns + 1.0f : turns;
}

static inline Mask is_ellipse(const Scene* scene, Int primitive) {
  return PRIMITIVE_INT(scene, primitive, region) == REGION_ELLIPSE;
}

// Texture coordinates of the point origin + a edge_u + b edge_v of a flat primitive.
static inline TextureCoordinates flat_uv(const Scene* scene, Int primitive, Real a, Real b) {
  TextureCoordinates at;
  at.u = fma(a, uv_value(scene, primitive, UV_PER_U),
             fma(b, uv_value(scene, primitive, UV_PER_V), uv_value(scene, primitive, UV_ORIGIN)));
  at.v = fma(a, uv_value(scene, primitive, UV_PER_U + 1),
             fma(b, uv_value(scene, primitive, UV_PER_V + 1), uv_value(scene, primitive, UV_ORIGIN + 1)));
  if (!HAS_ELLIPSES) return at;
  const Mask polar = is_ellipse(scene, primitive);
  if (!any_lane(polar)) return at;
  const Real radius = sqrt(fma(at.u, at.u, at.v * at.v)), turns = turns_of(at.u, at.v);
  at.u = polar ? radius : at.u;
  at.v = polar ? turns : at.v;
  return at;
}

// d position / d u, of any length; `from_origin` is the vector from the origin of the primitive to the point.
static inline Vec3 flat_tangent(const Scene* scene, Int primitive, Vec3 from_origin) {
  const Vec3 straight = uv_vector(scene, primitive, UV_TANGENT);
  return HAS_ELLIPSES ? vec_select(is_ellipse(scene, primitive), from_origin, straight) : straight;
}

// Components of a direction from the centre of a sphere along the axes of the object.
static inline Vec3 along_axes(const Scene* scene, Int primitive, Vec3 unit) {
  return vec3(vec_dot(unit, uv_vector(scene, primitive, UV_AXES)),
              vec_dot(unit, uv_vector(scene, primitive, UV_AXES + 3)),
              vec_dot(unit, uv_vector(scene, primitive, UV_AXES + 6)));
}

static inline TextureCoordinates sphere_uv(const Scene* scene, Int primitive, Vec3 unit) {
  const Vec3 d = along_axes(scene, primitive, unit);
  TextureCoordinates at;
  at.u = turns_of(d.x, d.y);
  at.v = INV_PI * atan2(sqrt(fma(d.x, d.x, d.y * d.y)), d.z); // acos would lose half of its digits at the poles
  return at;
}

// d position / d longitude, of any length.
static inline Vec3 sphere_tangent(const Scene* scene, Int primitive, Vec3 unit) {
  const Vec3 d = along_axes(scene, primitive, unit);
  return vec_along(vec_scale(d.x, uv_vector(scene, primitive, UV_AXES + 3)), -d.y,
                   uv_vector(scene, primitive, UV_AXES));
}

#endif
