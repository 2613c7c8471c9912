// Light that sets out: the first edge of a light path. Its density, the choice of the light included, is the light's
// emission_density (per projected solid angle where the light has a surface), so that the power which the edge carries
// is what the light sends along it over that density.
#ifndef PHLUX_EMISSION_CL
#define PHLUX_EMISSION_CL

#define PHLUX_LIGHTS_EMIT
#include "lights.cl"

typedef struct {
  Ray ray;       // from the light
  Vec3 radiance; // what the light sends along it: radiance, intensity or irradiance
  Real density;  // emission_density
  Place place;   // of lights with a surface
  Int light;
  Mask surface; // the light has one
  Mask sky;     // the light is constant: a point at infinity
} Emission;

#if defined(PHLUX_LIGHT_PLANAR) || defined(PHLUX_LIGHT_SPHERE)
// Leaves `place` by the cosine.
static inline void emit_from_surface(Emission* e, Place place, Vec3 upward, Mask m) {
  const Vec3 direction = from_frame(frame_about(place.normal), upward);
  e->place.position = vec_select(m, place.position, e->place.position);
  e->place.normal = vec_select(m, place.normal, e->place.normal);
  e->place.error = m ? place.error : e->place.error;
  e->ray.origin = vec_select(m, step_off(place.position, place.normal, place.error, direction), e->ray.origin);
  e->ray.direction = vec_select(m, direction, e->ray.direction);
  e->surface = e->surface | m;
}
#endif

#if defined(PHLUX_LIGHT_DIRECTIONAL) || defined(PHLUX_LIGHT_CONSTANT)
// Comes from outside the scene, through a point of the disk that the scene fills as seen along `direction`.
static inline void emit_from_infinity(const Scene* scene, Emission* e, Vec3 direction, Real u1, Real u2, Mask m) {
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  const Real disk_radius = sqrt(LIGHT_REAL(scene, e->light, area) * PHONG_INV_PI);
  const Real radius = disk_radius * sqrt(u1);
  const Frame frame = frame_about(direction);
  const Vec3 across = from_frame(frame, vec3(radius * cos_phi, radius * sin_phi, -disk_radius));
  e->ray.origin = vec_select(m, across, e->ray.origin);
  e->ray.direction = vec_select(m, direction, e->ray.direction);
}
#endif

// Chooses a light, a point of it (choice) and a direction (aim). All lanes.
static inline Emission emission_sample(const Scene* scene, RandomWords choice, RandomWords aim) {
  Emission e;
  e.light = choose_light(scene, choice.x, choice.y);
  e.radiance = LIGHT_VEC3(scene, e.light, power);
  e.density = LIGHT_REAL(scene, e.light, emission_density);
  e.surface = e.sky = NO_LANES;
  e.place.position = e.place.normal = e.ray.origin = e.ray.direction = vec_all((Real)(0.0f));
  e.place.error = (Real)(0.0f);
  const Int kind = light_kind(scene, e.light);
#ifdef PHLUX_LIGHT_PLANAR
  {
    const Mask m = LIGHT_IS(kind, LIGHT_PLANAR);
    emit_from_surface(&e, planar_light_point(scene, e.light, m, uniform_real(choice.z), uniform_real(choice.w)),
                      cosine_direction(uniform_real(aim.x), uniform_real(aim.y)), m);
  }
#endif
#ifdef PHLUX_LIGHT_SPHERE
  {
    const Mask m = LIGHT_IS(kind, LIGHT_SPHERE);
    const Int primitive = sphere_primitive(scene, e.light, m);
    const Mask front_inside = PRIMITIVE_INT(scene, primitive, region) != 0;
    const Vec3 unit = sphere_direction(uniform_real(choice.z), uniform_real(choice.w));
    emit_from_surface(&e, sphere_light_point(sphere_of_light(scene, primitive), unit, front_inside),
                      cosine_direction(uniform_real(aim.x), uniform_real(aim.y)), m);
  }
#endif
#if defined(PHLUX_LIGHT_POINT) || defined(PHLUX_LIGHT_SPOT)
  {
    const Mask m = LIGHT_IS(kind, LIGHT_POINT) | LIGHT_IS(kind, LIGHT_SPOT);
    Vec3 direction = sphere_direction(uniform_real(aim.x), uniform_real(aim.y));
#ifdef PHLUX_LIGHT_SPOT
    const Mask spot = LIGHT_IS(kind, LIGHT_SPOT);
    const Real cap = (0.5f * PHONG_INV_PI) * light_probability(scene, e.light) / e.density; // 1 - cos(cutoff)
    const Real drop = uniform_real(aim.x) * cap;
    const Real sine = sqrt(drop * (2.0f - drop));
    const Frame about_axis = frame_about(LIGHT_VEC3(scene, e.light, direction));
    direction =
        vec_select(spot, from_frame(about_axis, polar_direction(sine, 1.0f - drop, uniform_real(aim.y))), direction);
    const Real falloff = spot ? spot_falloff(scene, e.light, 1.0f - drop) : (Real)(1.0f);
    e.radiance = vec_scale(falloff, e.radiance);
#endif
    e.ray.origin = vec_select(m, LIGHT_VEC3(scene, e.light, position), e.ray.origin);
    e.ray.direction = vec_select(m, direction, e.ray.direction);
  }
#endif
#ifdef PHLUX_LIGHT_DIRECTIONAL
  emit_from_infinity(scene, &e, LIGHT_VEC3(scene, e.light, direction), uniform_real(choice.z), uniform_real(choice.w),
                     LIGHT_IS(kind, LIGHT_DIRECTIONAL));
#endif
#ifdef PHLUX_LIGHT_CONSTANT
  e.sky = LIGHT_IS(kind, LIGHT_CONSTANT);
  emit_from_infinity(scene, &e, sphere_direction(uniform_real(aim.x), uniform_real(aim.y)), uniform_real(choice.z),
                     uniform_real(choice.w), e.sky);
#endif
  return e;
}

#endif
