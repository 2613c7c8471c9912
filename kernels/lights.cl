// Lights: choosing one, choosing a direction towards it, and the density with which that direction is chosen.
// Densities are per solid angle at the lit point and include the probability of choosing the light.
#ifndef PHLUX_LIGHTS_CL
#define PHLUX_LIGHTS_CL

#include "phong.cl"
#include "random.h"
#include "surface.cl"

#if PHLUX_CONNECT != CONNECT_NONE

typedef struct {
  Ray ray;       // from the lit point, stepped off its surface, to the light
  Real distance; // before which the ray must be free
  Vec3 radiance; // arriving along it; for a light without a surface, what stands for radiance / density (density is 1)
  Real density;
  Mask hittable; // a ray along a sampled direction of the surface could find this light as well
  Mask valid;    // something arrives: the light faces the point
} LightSample;

// The light for one random word (the other decides between the two lights of the cell), by the alias method.
static inline Int choose_light(const Scene* scene, Uint cell_word, Uint alias_word) {
#ifdef PHLUX_LIGHT_CHOICE
  const Int cell = uint_to_int(mul_hi(cell_word, (Uint)((uint)scene->light_count)));
  const Mask keep = uniform_real(alias_word) < GATHER_REAL(scene->lights, cell, alias_threshold);
  return keep ? cell : GATHER_INT(scene->lights, cell, alias);
#else
  return (Int)(0);
#endif
}

static inline Real light_probability(const Scene* scene, Int light) {
#ifdef PHLUX_LIGHT_CHOICE
  return GATHER_REAL(scene->lights, light, probability);
#else
  return (Real)(1.0f);
#endif
}

#ifdef PHLUX_LIGHT_SPHERE
// The cone that a sphere fills as seen from outside: 1 - cos of its half angle, without cancellation.
static inline Real one_minus_cone_cosine(SphereShape sphere, Real distance2) {
  const Real sine2 = sphere.radius * sphere.radius / distance2;
  return sine2 / (1.0f + sqrt(larger(1.0f - sine2, (Real)(0.0f))));
}
#endif

// Density with which light_sample at `lit` would have chosen the direction of `ray`, which found `hit_point` on the
// front of `light` after `distance`; without meaning in lanes that found no light.
static inline Real light_density_of_hit(const Scene* scene, Vec3 lit, Ray ray, Real distance, SurfacePoint hit_point,
                                        Int light) {
  const Real choice = light_probability(scene, light);
  const Real cosine = -vec_dot(hit_point.normal, ray.direction);
  Real density = choice * distance * distance / (cosine * GATHER_REAL(scene->lights, light, area));
#ifdef PHLUX_LIGHT_SPHERE
  const Mask is_sphere = GATHER_INT(scene->lights, light, kind) == LIGHT_SPHERE;
  const Int primitive = GATHER_INT(scene->lights, light, primitive);
#ifdef PHLUX_PLANARS
  const SphereShape sphere = gather_sphere(scene, max(primitive - scene->first_sphere, (Int)(0)));
#else
  const SphereShape sphere = gather_sphere(scene, primitive);
#endif
  const Vec3 to_center = vec_sub(sphere.center, lit);
  const Real distance2 = vec_dot(to_center, to_center);
  const Mask outside =
      (distance2 > sphere.radius * sphere.radius) & (GATHER_INT(scene->primitives, primitive, region) == 0);
  const Real cone = choice * (0.5f * PHONG_INV_PI) / one_minus_cone_cosine(sphere, distance2);
  density = (is_sphere & outside) ? cone : density;
#endif
  return density;
}

// The direction from `lit` to a point on a light's surface whose outward front normal is `normal`.
static inline void aim_at(LightSample* s, SurfacePoint lit, Vec3 target, Vec3 normal, Real target_error) {
  const Vec3 direct = vec_sub(target, lit.position);
  const Real reach = vec_largest(direct);
  s->ray.origin = step_off(lit.position, lit.normal, lit.error, direct);
  // Stop short of the light by what its crossing may be wrong as seen from here.
  const Vec3 end = vec_along(target, target_error + ERROR_UNITS * reach, normal);
  const Vec3 way = vec_sub(end, s->ray.origin);
  s->distance = sqrt(vec_dot(way, way));
  s->ray.direction = vec_scale((Real)(1.0f) / s->distance, way);
}

// Takes `mine`, a point of a light's surface, into *s in the lanes of m.
static inline void keep_surface_sample(LightSample* s, LightSample mine, Mask m, Mask faces) {
  s->ray.origin = vec_select(m, mine.ray.origin, s->ray.origin);
  s->ray.direction = vec_select(m, mine.ray.direction, s->ray.direction);
  s->distance = m ? mine.distance : s->distance;
  s->density = m ? mine.density : s->density;
  s->hittable = s->hittable | m;
  s->valid = s->valid | (m & faces);
}

#ifdef PHLUX_LIGHT_PLANAR
// A point of a flat light, uniform over its area.
static inline void sample_planar_light(const Scene* scene, LightSample* s, SurfacePoint lit, Int light, Mask m, Real u1,
                                       Real u2) {
  const Int primitive = m ? GATHER_INT(scene->lights, light, primitive) : (Int)(0);
  const Int words = planar_words(primitive);
#if defined(PHLUX_TRIANGLES) || defined(PHLUX_ELLIPSES)
  const Int region = GATHER_INT(scene->primitives, primitive, region);
#endif
  const Real area = GATHER_REAL(scene->lights, light, area);
  // |edge_u x edge_v| from the area of the region that it spans; the parallelogram's is 4 of them.
  Real u = 2.0f * u1 - 1.0f, v = 2.0f * u2 - 1.0f, cross_length = 0.25f * area;
#ifdef PHLUX_TRIANGLES
  const Mask triangle = region == REGION_TRIANGLE;
  const Real root = sqrt(u1);
  u = triangle ? 1.0f - root : u;
  v = triangle ? root * u2 : v;
  cross_length = triangle ? 2.0f * area : cross_length;
#endif
#ifdef PHLUX_ELLIPSES
  const Mask ellipse = region == REGION_ELLIPSE;
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  const Real radius = sqrt(u1);
  u = ellipse ? radius * cos_phi : u;
  v = ellipse ? radius * sin_phi : v;
  cross_length = ellipse ? area * PHONG_INV_PI : cross_length;
#endif
  const Vec3 normal = gather_planar(scene, words, PLANAR_NORMAL);
  const Vec3 origin = gather_planar(scene, words, PLANAR_ORIGIN);
  const Vec3 edge_part = vec_along(vec_scale(-u, gather_planar(scene, words, PLANAR_MINUS_U)), v,
                                   gather_planar(scene, words, PLANAR_EDGE_V));
  const Vec3 from_origin = vec_scale(cross_length, edge_part);
  const Vec3 target = vec_add(origin, from_origin);
  LightSample mine = *s;
  aim_at(&mine, lit, target, normal, ERROR_UNITS * (vec_largest(target) + vec_largest(from_origin)));
  const Real cosine = -vec_dot(normal, mine.ray.direction);
  mine.density = light_probability(scene, light) * mine.distance * mine.distance / (cosine * area);
  keep_surface_sample(s, mine, m, cosine > 0.0f);
}
#endif

#ifdef PHLUX_LIGHT_SPHERE
// A point of a sphere: uniform in the cone that it fills from outside, else uniform over its area.
static inline void sample_sphere_light(const Scene* scene, LightSample* s, SurfacePoint lit, Int light, Mask m, Real u1,
                                       Real u2) {
#ifdef PHLUX_PLANARS
  const Int primitive = m ? GATHER_INT(scene->lights, light, primitive) : (Int)(scene->first_sphere);
  const SphereShape sphere = gather_sphere(scene, primitive - scene->first_sphere);
#else
  const Int primitive = m ? GATHER_INT(scene->lights, light, primitive) : (Int)(0);
  const SphereShape sphere = gather_sphere(scene, primitive);
#endif
  const Mask front_inside = GATHER_INT(scene->primitives, primitive, region) != 0;
  const Vec3 to_center = vec_sub(sphere.center, lit.position);
  const Real distance2 = vec_dot(to_center, to_center);
  const Real center_distance = sqrt(distance2);
  const Mask in_cone = (distance2 > sphere.radius * sphere.radius) & !front_inside;
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  // In the cone: the sphere's near point at angle theta from the centre's direction; its direction from the centre has
  // cosine (center_distance sin^2(theta) + cos(theta) sqrt(r^2 - center_distance^2 sin^2(theta))) / r to the lit point.
  const Real cone = one_minus_cone_cosine(sphere, distance2);
  const Real drop = u1 * cone; // 1 - cos(theta)
  const Real sine2 = drop * (2.0f - drop);
  const Real half_chord = sqrt(larger(fma(sphere.radius, sphere.radius, -distance2 * sine2), (Real)(0.0f)));
  const Real cosine_at_center =
      smaller((center_distance * sine2 + (1.0f - drop) * half_chord) / sphere.radius, (Real)(1.0f));
  const Real z = in_cone ? cosine_at_center : 1.0f - 2.0f * u1;
  const Real r = sqrt(larger(1.0f - z * z, (Real)(0.0f)));
  const Frame towards_lit = frame_about(vec_scale(-1.0f / center_distance, to_center));
  const Vec3 unit = from_frame(towards_lit, vec3(r * cos_phi, r * sin_phi, z));
  const Vec3 target = vec_along(sphere.center, sphere.radius, unit);
  const Vec3 normal = vec_select(front_inside, vec_scale((Real)(-1.0f), unit), unit);
  LightSample mine = *s;
  aim_at(&mine, lit, target, normal, ERROR_UNITS * (vec_largest(sphere.center) + sphere.radius));
  const Real cosine = -vec_dot(normal, mine.ray.direction);
  const Real choice = light_probability(scene, light);
  const Real by_area = choice * mine.distance * mine.distance / (cosine * GATHER_REAL(scene->lights, light, area));
  mine.density = in_cone ? choice * (0.5f * PHONG_INV_PI) / cone : by_area;
  keep_surface_sample(s, mine, m, cosine > 0.0f);
}
#endif

#if defined(PHLUX_LIGHT_POINT) || defined(PHLUX_LIGHT_SPOT)
// A light without extent: radiance / density is intensity / distance^2 / the probability of choosing it.
static inline void sample_point_light(const Scene* scene, LightSample* s, SurfacePoint lit, Int light, Int kind,
                                      Mask m) {
  const Vec3 position = GATHER_VEC3(scene->lights, light, position);
  const Vec3 origin = step_off(lit.position, lit.normal, lit.error, vec_sub(position, lit.position));
  const Vec3 way = vec_sub(position, origin);
  const Real distance2 = vec_dot(way, way), distance = sqrt(distance2);
  const Vec3 direction = vec_scale(1.0f / distance, way);
  Real falloff = 1.0f / (distance2 * light_probability(scene, light));
#ifdef PHLUX_LIGHT_SPOT
  const Vec3 axis = GATHER_VEC3(scene->lights, light, direction);
  const Real angle = acos(clamp(-vec_dot(axis, direction), (Real)(-1.0f), (Real)(1.0f)));
  const Real cone =
      clamp((GATHER_REAL(scene->lights, light, cutoff) - angle) * GATHER_REAL(scene->lights, light, inv_transition),
            (Real)(0.0f), (Real)(1.0f));
  falloff = kind == LIGHT_SPOT ? falloff * cone : falloff;
#endif
  s->ray.origin = vec_select(m, origin, s->ray.origin);
  s->ray.direction = vec_select(m, direction, s->ray.direction);
  s->distance = m ? distance : s->distance;
  s->density = m ? (Real)(1.0f) : s->density;
  s->radiance = vec_select(m, vec_scale(falloff, s->radiance), s->radiance);
  s->valid = s->valid | (m & (distance2 > 0.0f));
}
#endif

#if defined(PHLUX_LIGHT_DIRECTIONAL) || defined(PHLUX_LIGHT_CONSTANT)
static inline void aim_to_infinity(LightSample* s, SurfacePoint lit, Vec3 direction, Mask m) {
  s->ray.origin = vec_select(m, step_off(lit.position, lit.normal, lit.error, direction), s->ray.origin);
  s->ray.direction = vec_select(m, direction, s->ray.direction);
  s->distance = m ? (Real)(INFINITY) : s->distance;
  s->valid = s->valid | m;
}
#endif

// Chooses a light for each point and a direction towards it. All lanes.
static inline LightSample light_sample(const Scene* scene, SurfacePoint lit, RandomWords words) {
  const Int light = choose_light(scene, words.x, words.y);
  const Real u1 = uniform_real(words.z), u2 = uniform_real(words.w);
#ifdef PHLUX_LIGHT_KINDS
  const Int kind = GATHER_INT(scene->lights, light, kind);
#define LIGHT_IS(which) (kind == (which))
#else
#define LIGHT_IS(which) ALL_LANES
#endif
  LightSample s;
  s.ray.origin = lit.position;
  s.ray.direction = lit.normal;
  s.distance = (Real)(0.0f);
  s.radiance = GATHER_VEC3(scene->lights, light, power);
  s.density = (Real)(1.0f);
  s.hittable = NO_LANES;
  s.valid = NO_LANES;
#ifdef PHLUX_LIGHT_PLANAR
  sample_planar_light(scene, &s, lit, light, LIGHT_IS(LIGHT_PLANAR), u1, u2);
#endif
#ifdef PHLUX_LIGHT_SPHERE
  sample_sphere_light(scene, &s, lit, light, LIGHT_IS(LIGHT_SPHERE), u1, u2);
#endif
#if defined(PHLUX_LIGHT_POINT) || defined(PHLUX_LIGHT_SPOT)
#ifdef PHLUX_LIGHT_KINDS
  sample_point_light(scene, &s, lit, light, kind, LIGHT_IS(LIGHT_POINT) | LIGHT_IS(LIGHT_SPOT));
#else
  sample_point_light(scene, &s, lit, light, GATHER_INT(scene->lights, light, kind), ALL_LANES);
#endif
#endif
#ifdef PHLUX_LIGHT_DIRECTIONAL
  {
    const Mask m = LIGHT_IS(LIGHT_DIRECTIONAL);
    const Vec3 against = vec_scale((Real)(-1.0f), GATHER_VEC3(scene->lights, light, direction));
    aim_to_infinity(&s, lit, against, m);
    s.radiance = vec_select(m, vec_scale(1.0f / light_probability(scene, light), s.radiance), s.radiance);
  }
#endif
#ifdef PHLUX_LIGHT_CONSTANT
  {
    const Mask m = LIGHT_IS(LIGHT_CONSTANT);
    const Vec3 upward = cosine_direction(u1, u2);
    aim_to_infinity(&s, lit, from_frame(lit.frame, upward), m);
    s.density = m ? light_probability(scene, light) * upward.z * PHONG_INV_PI : s.density;
    s.hittable = s.hittable | m;
  }
#endif
#undef LIGHT_IS
  return s;
}

#endif
#endif
