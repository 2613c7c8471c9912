// Light samples: the choice of a light, of a direction towards it, and the density of that direction. Densities are per
// solid angle at the lit point and include the probability of the light. emission.cl samples paths that start at
// lights.
#ifndef PHLUX_LIGHTS_CL
#define PHLUX_LIGHTS_CL

#include "math/constants.h"
#include "math/directions.h"
#include "math/random.h"
#include "scene/environment.cl"
#include "scene/light_tree.cl"
#include "scene/surface.cl"

// Lanes whose light is of this kind; all lanes if the scene has a single kind.
#define LIGHT_IS(kind, which) (LIGHT_KINDS > 1 ? (Mask)((kind) == (which)) : ALL_LANES)

// ---- Choosing a light

// The sky, which is the last light if the scene has one.
static inline int sky_light(const Scene* scene) { return scene->light_count - 1; }

// Chooses the sky with its probability, else another light by the alias method (Walker 1974; Vose 1991). The
// probabilities of the other lights have the same ratios in light paths and in light samples.
static inline Int choose_light(const Scene* scene, Uint cell_word, Uint alias_word, float sky_probability) {
  if (!HAS_LIGHT_CHOICE) return (Int)(0);
  const Int cell = uint_to_int(mul_hi(cell_word, (Uint)((uint)scene->light_count)));
  const Real u = uniform_real(alias_word);
  const Real threshold = LIGHT_REAL(scene, cell, alias_threshold);
  const Real kept = HAS_SKY ? fma(threshold, (Real)(1.0f - sky_probability), (Real)(sky_probability)) : threshold;
  const Int other = u < kept ? cell : LIGHT_INT(scene, cell, alias);
  if (!HAS_SKY) return other;
  // The choice of the sky uses all 32 bits of the word. u has only 23, which is too few for a small probability.
  const Mask sky =
      sky_probability < 1.0f ? (Mask)(alias_word < (Uint)((uint)(4294967296.0f * sky_probability))) : ALL_LANES;
  return sky ? (Int)(sky_light(scene)) : other;
}

// Chooses a light for a light path, with the probability LightRecord.probability.
static inline Int choose_emitting_light(const Scene* scene, Uint cell_word, Uint alias_word) {
  return choose_light(scene, cell_word, alias_word, scene->lights[sky_light(scene)].probability);
}

static inline Int light_kind(const Scene* scene, Int light) {
  return LIGHT_KINDS > 1 ? LIGHT_INT(scene, light, kind) : (Int)(scene->lights[0].kind);
}

// Lanes whose light a ray can hit.
static inline Mask is_hittable(Int kind) {
  return (kind != LIGHT_POINT) & (kind != LIGHT_SPOT) & (kind != LIGHT_DIRECTIONAL);
}
static inline Mask is_pointlike(Int kind) { return LIGHT_IS(kind, LIGHT_POINT) | LIGHT_IS(kind, LIGHT_SPOT); }

// Lanes whose light is the sky.
static inline Mask is_sky(Int kind) { return LIGHT_IS(kind, LIGHT_SKY); }

// The probability with which light_sample chooses `light` for a point with this normal, in the lanes of m.
static inline Real probability_for(const Scene* scene, Vec3 lit, Vec3 normal, Int light, Mask m) {
  const Real by_power = HAS_LIGHT_CHOICE ? LIGHT_REAL(scene, light, sample_probability) : (Real)(1.0f);
  if (!HAS_LIGHT_TREE) return by_power;
  const Int leaf = LIGHT_INT(scene, light, node);
  const Mask placed = leaf >= 0;
  const Real in_tree = scene->light_tree_probability * tree_probability(scene, lit, normal, leaf, m & placed);
  return placed ? POWER_SHARE * by_power + (1.0f - POWER_SHARE) * in_tree : by_power;
}

// Chooses a light for a point with this normal: first by power; if that light is in the tree, it is replaced with the
// probability 1 - POWER_SHARE by one that the tree chooses.
static inline Int choose_light_for(const Scene* scene, Vec3 lit, Vec3 normal, Uint word, Uint other_word) {
  const float sky_probability = HAS_SKY_SAMPLES ? scene->lights[sky_light(scene)].sample_probability : 0.0f;
  const Int light = choose_light(scene, word, other_word, sky_probability);
  if (!HAS_LIGHT_TREE) return light;
  const Mask by_tree = uniform_real(further_word(word, other_word, (Uint)(1u))) >= POWER_SHARE;
  return choose_from_tree(scene, lit, normal, word, other_word, by_tree & (LIGHT_INT(scene, light, node) >= 0), light);
}

// The normal on which the choice of a light for a point depends: the one that determines which lights can illuminate
// it; 0 if the material transmits light, so that the probability does not depend on the side from which a subpath came.
static inline Vec3 lit_normal(SurfacePoint point) {
  const Vec3 normal = SIDES_BY_SHADING ? point.frame.z : point.normal;
  return HAS_TRANSMISSION ? vec_select(point.transmits, vec_all((Real)(0.0f)), normal) : normal;
}

// The density of emission (emission.cl); for an environment map, in a direction whose density is `sky`.
static inline Real emission_density(const Scene* scene, Int light, Real sky) {
  const Real density = LIGHT_REAL(scene, light, emission_density);
  if (!HAS_ENVIRONMENT_MAP) return density;
  return is_sky(light_kind(scene, light)) ? density * sky : density;
}

// ---- Points of lights

// A point of a flat light, uniform over its area, in the lanes of m; its normal is on the side that emits.
static inline SurfacePosition planar_light_point(const Scene* scene, Int light, Mask m, Real u1, Real u2) {
  const Int primitive = m ? LIGHT_INT(scene, light, primitive) : (Int)(0);
  const Int words = planar_words(primitive);
  const Int region = PRIMITIVE_INT(scene, primitive, region);
  const Real area = LIGHT_REAL(scene, light, area);
  // |edge_u x edge_v| from the area of the region; that of the parallelogram is 4 |edge_u x edge_v|.
  Real u = 2.0f * u1 - 1.0f, v = 2.0f * u2 - 1.0f, cross_length = 0.25f * area;
  if (HAS_TRIANGLES) {
    const Mask triangle = region == REGION_TRIANGLE;
    const Real root = sqrt(u1);
    u = triangle ? 1.0f - root : u;
    v = triangle ? root * u2 : v;
    cross_length = triangle ? 2.0f * area : cross_length;
  }
  if (HAS_ELLIPSES) {
    const Mask ellipse = region == REGION_ELLIPSE;
    Real cos_phi, sin_phi;
    cos_sin_turns(u2, &cos_phi, &sin_phi);
    const Real radius = sqrt(u1);
    u = ellipse ? radius * cos_phi : u;
    v = ellipse ? radius * sin_phi : v;
    cross_length = ellipse ? area * INV_PI : cross_length;
  }
  const Vec3 origin = gather_planar(scene, words, PLANAR_ORIGIN);
  const Vec3 edge_part = vec_along(vec_scale(-u, gather_planar(scene, words, PLANAR_MINUS_U)), v,
                                   gather_planar(scene, words, PLANAR_EDGE_V));
  const Vec3 from_origin = vec_scale(cross_length, edge_part);
  SurfacePosition point;
  point.position = vec_add(origin, from_origin);
  point.normal = gather_planar(scene, words, PLANAR_NORMAL);
  point.error = ERROR_UNITS * (vec_largest(point.position) + vec_largest(from_origin));
  return point;
}

// The primitive of a spherical light in the lanes of m; the first sphere in other lanes.
static inline Int sphere_primitive(const Scene* scene, Int light, Mask m) {
  return m ? LIGHT_INT(scene, light, primitive) : (Int)(HAS_PLANARS ? scene->first_sphere : 0);
}

static inline SphereShape sphere_of_light(const Scene* scene, Int primitive) {
  return gather_sphere(scene, HAS_PLANARS ? primitive - scene->first_sphere : primitive);
}

// The point of a spherical light in the direction `unit` from its centre; its normal is on the side that emits.
static inline SurfacePosition sphere_light_point(SphereShape sphere, Vec3 unit, Mask front_inside) {
  SurfacePosition point;
  point.position = vec_along(sphere.center, sphere.radius, unit);
  point.normal = vec_select(front_inside, vec_scale((Real)(-1.0f), unit), unit);
  point.error = ERROR_UNITS * (vec_largest(sphere.center) + sphere.radius);
  return point;
}

// The intensity of a spot light at this angle to its axis, divided by that on the axis.
static inline Real spot_falloff(const Scene* scene, Int light, Real angle) {
  return clamp((LIGHT_REAL(scene, light, cutoff) - angle) * LIGHT_REAL(scene, light, inv_transition), (Real)(0.0f),
               (Real)(1.0f));
}
// ---- Light samples

typedef struct {
  Ray ray;       // from the lit point, offset from its surface, to the light
  Real distance; // up to which the ray must be unoccluded
  Vec3 radiance; // emitted radiance; for a light without a surface: intensity or irradiance
  Real density;  // per solid angle; without a surface: choice x distance^2 (point, spot) or choice (directional)
  Int light;
  Real choice;   // the probability of choosing the light
  Mask hittable; // a ray in a direction sampled by scattering could hit this light too
  Mask valid;    // the light faces the point
} LightSample;

// The density per solid angle, at the lit point, of a point that is uniform over the area of the light; `cosine` is
// that of the normal of the light with the direction to the lit point.
static inline Real density_by_area(const Scene* scene, Int light, Real distance, Real cosine) {
  return distance * distance / (cosine * LIGHT_REAL(scene, light, area));
}

// 1 - cos of the half angle of the cone that a sphere subtends from outside, without cancellation.
static inline Real one_minus_cone_cosine(SphereShape sphere, Real distance2) {
  const Real sine2 = sphere.radius * sphere.radius / distance2;
  return sine2 / (1.0f + sqrt(larger(1.0f - sine2, (Real)(0.0f))));
}

// Density with which light_sample at `lit`, if it chooses `light` with the probability `choice`, finds the point of the
// light at `distance`, where `cosine` is that of the normal of the light with the direction to `lit`. Undefined in
// lanes whose light has no surface.
static inline Real light_density(const Scene* scene, Vec3 lit, Int light, Real choice, Real distance, Real cosine) {
  Real density = choice * density_by_area(scene, light, distance, cosine);
  if (HAS_SPHERE_LIGHTS) {
    const Mask is_sphere = LIGHT_IS(light_kind(scene, light), LIGHT_SPHERE);
    const Int primitive = sphere_primitive(scene, light, is_sphere);
    const SphereShape sphere = sphere_of_light(scene, primitive);
    const Vec3 to_center = vec_sub(sphere.center, lit);
    const Real distance2 = vec_dot(to_center, to_center);
    const Mask outside = (distance2 > sphere.radius * sphere.radius) & (PRIMITIVE_INT(scene, primitive, region) == 0);
    const Real cone = choice * (0.5f * INV_PI) / one_minus_cone_cosine(sphere, distance2);
    density = (is_sphere & outside) ? cone : density;
  }
  return density;
}

// Sets the sample in the lanes of m.
static inline void keep_sample(LightSample* s, Ray ray, Real distance, Real density, Mask valid, Mask m) {
  s->ray = select_ray(m, ray, s->ray);
  s->distance = m ? distance : s->distance;
  s->density = m ? density : s->density;
  s->valid = s->valid | (m & valid);
}

static inline void sample_planar_light(const Scene* scene, LightSample* s, SurfacePosition lit, Mask m, Real u1,
                                       Real u2) {
  const SurfacePosition place = planar_light_point(scene, s->light, m, u1, u2);
  Real distance;
  const Ray ray = ray_between(lit, place, &distance);
  const Real cosine = -vec_dot(place.normal, ray.direction);
  const Real density = s->choice * density_by_area(scene, s->light, distance, cosine);
  keep_sample(s, ray, distance, density, cosine > 0.0f, m);
  s->hittable = s->hittable | m;
}

// A point of a sphere: uniform in solid angle if seen from outside, else uniform over its area.
static inline void sample_sphere_light(const Scene* scene, LightSample* s, SurfacePosition lit, Mask m, Real u1,
                                       Real u2) {
  const Int primitive = sphere_primitive(scene, s->light, m);
  const SphereShape sphere = sphere_of_light(scene, primitive);
  const Mask front_inside = PRIMITIVE_INT(scene, primitive, region) != 0;
  const Vec3 to_center = vec_sub(sphere.center, lit.position);
  const Real distance2 = vec_dot(to_center, to_center);
  const Real center_distance = sqrt(distance2);
  const Mask in_cone = (distance2 > sphere.radius * sphere.radius) & !front_inside;
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  // In the cone: the near point of the sphere at the angle theta from its centre; its direction from the centre has the
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
  const SurfacePosition place = sphere_light_point(sphere, unit, front_inside);
  Real distance;
  const Ray ray = ray_between(lit, place, &distance);
  const Real cosine = -vec_dot(place.normal, ray.direction);
  const Real by_area = density_by_area(scene, s->light, distance, cosine);
  const Real density = in_cone ? (0.5f * INV_PI) / cone : by_area;
  keep_sample(s, ray, distance, s->choice * density, cosine > 0.0f, m);
  s->hittable = s->hittable | m;
}

static inline void sample_point_light(const Scene* scene, LightSample* s, SurfacePosition lit, Int kind, Mask m) {
  Real distance;
  const Ray ray = ray_to_point(lit, LIGHT_VEC3(scene, s->light, position), &distance);
  const Real density = distance * distance * s->choice;
  if (HAS_SPOT_LIGHTS) {
    const Real angle = vec_angle(LIGHT_VEC3(scene, s->light, direction), vec_scale((Real)(-1.0f), ray.direction));
    const Real falloff = kind == LIGHT_SPOT ? spot_falloff(scene, s->light, angle) : (Real)(1.0f);
    s->radiance = vec_select(m, vec_scale(falloff, s->radiance), s->radiance);
  }
  keep_sample(s, ray, distance, density, density > 0.0f, m);
}

static inline void aim_to_infinity(LightSample* s, SurfacePosition lit, Vec3 direction, Real density, Mask m) {
  const Ray ray = {offset_origin(lit.position, lit.normal, lit.error, direction), direction};
  keep_sample(s, ray, (Real)(INFINITY), density, ALL_LANES, m);
}

// Density with which a constant light is sampled in a direction at this cosine to the shading normal: cos / pi, on both
// sides if the material transmits light.
static inline Real sky_sample_density(SurfacePoint point, Real cosine) {
  if (!HAS_TRANSMISSION) return cosine * INV_PI;
  return point.transmits ? fabs(cosine) * (0.5f * INV_PI) : larger(cosine, (Real)(0.0f)) * INV_PI;
}
static inline Vec3 sky_sample_direction(SurfacePoint point, Real u1, Real u2) {
  if (!HAS_TRANSMISSION) return cosine_direction(u1, u2);
  const Mask below = point.transmits & (u1 >= 0.5f);
  const Vec3 direction = cosine_direction(point.transmits ? 2.0f * u1 - (below ? (Real)(1.0f) : (Real)(0.0f)) : u1, u2);
  return vec3(direction.x, direction.y, below ? -direction.z : direction.z);
}

// A direction to the sky: with the density cos / pi if it is constant, else that of the environment map.
static inline void sample_sky(const Scene* scene, LightSample* s, SurfacePoint point, Mask m, Real u1, Real u2,
                              RandomDraws random) {
  const SurfacePosition lit = surface_position(point);
  if (HAS_ENVIRONMENT_MAP) {
    if (!any_lane(m)) return;
    // Without a choice among lights, none of the words of the draw has been used.
    const Vec3 direction = sample_environment(scene, HAS_LIGHT_CHOICE ? draw_again(random, 1) : random.words);
    const Environment sky = environment_towards(scene, direction);
    aim_to_infinity(s, lit, direction, s->choice * sky.density, m & (sky.density > 0.0f));
    s->radiance = vec_select(m, sky.radiance, s->radiance);
  } else {
    const Vec3 direction = sky_sample_direction(point, u1, u2);
    aim_to_infinity(s, lit, from_frame(point.frame, direction), s->choice * sky_sample_density(point, direction.z), m);
  }
  s->hittable = s->hittable | m;
}

// Chooses a light for each point and a direction towards it, in all lanes.
static inline LightSample light_sample(const Scene* scene, SurfacePoint point, RandomDraws random) {
  const SurfacePosition lit = surface_position(point);
  const RandomWords words = random.words;
  LightSample s;
  s.light = choose_light_for(scene, lit.position, lit_normal(point), words.x, words.y);
  s.choice = probability_for(scene, lit.position, lit_normal(point), s.light, ALL_LANES);
  s.ray.origin = lit.position;
  s.ray.direction = lit.normal;
  s.distance = (Real)(0.0f);
  s.radiance = LIGHT_VEC3(scene, s.light, radiance);
  s.density = (Real)(1.0f);
  s.hittable = NO_LANES;
  s.valid = NO_LANES;
  const Int kind = light_kind(scene, s.light);
  const Real u1 = uniform_real(words.z), u2 = uniform_real(words.w);
  if (HAS_PLANAR_LIGHTS) sample_planar_light(scene, &s, lit, LIGHT_IS(kind, LIGHT_PLANAR), u1, u2);
  if (HAS_SPHERE_LIGHTS) sample_sphere_light(scene, &s, lit, LIGHT_IS(kind, LIGHT_SPHERE), u1, u2);
  if (HAS_POINTLIKE_LIGHTS) sample_point_light(scene, &s, lit, kind, is_pointlike(kind));
  if (HAS_DIRECTIONAL_LIGHTS) {
    const Vec3 to_light = vec_scale((Real)(-1.0f), LIGHT_VEC3(scene, s.light, direction));
    aim_to_infinity(&s, lit, to_light, s.choice, LIGHT_IS(kind, LIGHT_DIRECTIONAL));
  }
  if (HAS_SKY_SAMPLES) sample_sky(scene, &s, point, is_sky(kind), u1, u2, random);
  return s;
}

#endif
