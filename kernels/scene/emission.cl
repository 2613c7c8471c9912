// Emission: samples the first edge of a light path. Its density, which includes the choice of the light, is the
// emission_density of the light (per area and projected solid angle if the light has a surface); for an environment map
// this is multiplied by the density of the direction. The power of the edge is the emitted radiance divided by the
// density.
#ifndef PHLUX_EMISSION_CL
#define PHLUX_EMISSION_CL

#include "scene/lights.cl"

typedef struct {
  Ray ray;       // from the light
  Vec3 radiance; // emitted along the ray: radiance, intensity or irradiance
  Real density;
  SurfacePosition origin; // of lights with a surface
  Int light;
  Mask surface;     // the light has one
  Mask sky;         // the light is a point at infinity of the sky
  Real sky_density; // of the direction to it, per solid angle
} Emission;

// Emission from a point of a surface in the direction `upward`, in the frame of the surface.
static inline void emit_from_surface(Emission* e, SurfacePosition from, Vec3 upward, Mask m) {
  const Vec3 direction = from_frame(frame_about(from.normal), upward);
  e->origin.position = vec_select(m, from.position, e->origin.position);
  e->origin.normal = vec_select(m, from.normal, e->origin.normal);
  e->origin.error = m ? from.error : e->origin.error;
  const Ray ray = {offset_origin(from.position, from.normal, from.error, direction), direction};
  e->ray = select_ray(m, ray, e->ray);
  e->surface = e->surface | m;
}

// Emission from outside the scene along `direction`, uniform over the disk that is the projection of the scene's
// bounding sphere.
static inline void emit_from_infinity(const Scene* scene, Emission* e, Vec3 direction, Real u1, Real u2, Mask m) {
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  const Real disk_radius = sqrt(LIGHT_REAL(scene, e->light, area) * INV_PI);
  const Real radius = disk_radius * sqrt(u1);
  const Frame frame = frame_about(direction);
  const Ray ray = {from_frame(frame, vec3(radius * cos_phi, radius * sin_phi, -disk_radius)), direction};
  e->ray = select_ray(m, ray, e->ray);
}

// Samples a light and a point of it (choice), and a direction (aim), in all lanes.
static inline Emission emission_sample(const Scene* scene, RandomWords choice, RandomWords aim) {
  Emission e;
  e.light = choose_emitting_light(scene, choice.x, choice.y);
  e.radiance = LIGHT_VEC3(scene, e.light, radiance);
  e.density = LIGHT_REAL(scene, e.light, emission_density);
  e.surface = e.sky = NO_LANES;
  e.origin.position = e.origin.normal = e.ray.origin = e.ray.direction = vec_all((Real)(0.0f));
  e.origin.error = (Real)(0.0f);
  e.sky_density = (Real)(0.25f * INV_PI);
  const Int kind = light_kind(scene, e.light);
  const Real u1 = uniform_real(choice.z), u2 = uniform_real(choice.w);
  const Real v1 = uniform_real(aim.x), v2 = uniform_real(aim.y);
  if (HAS_PLANAR_LIGHTS) {
    const Mask m = LIGHT_IS(kind, LIGHT_PLANAR);
    emit_from_surface(&e, planar_light_point(scene, e.light, m, u1, u2), cosine_direction(v1, v2), m);
  }
  if (HAS_SPHERE_LIGHTS) {
    const Mask m = LIGHT_IS(kind, LIGHT_SPHERE);
    const Int primitive = sphere_primitive(scene, e.light, m);
    const Mask front_inside = PRIMITIVE_INT(scene, primitive, region) != 0;
    const SurfacePosition from =
        sphere_light_point(sphere_of_light(scene, primitive), sphere_direction(u1, u2), front_inside);
    emit_from_surface(&e, from, cosine_direction(v1, v2), m);
  }
  if (HAS_POINTLIKE_LIGHTS) {
    const Mask m = is_pointlike(kind);
    Vec3 direction = sphere_direction(v1, v2);
    if (HAS_SPOT_LIGHTS) {
      const Mask spot = LIGHT_IS(kind, LIGHT_SPOT);
      const Real cap = (0.5f * INV_PI) * LIGHT_REAL(scene, e.light, probability) / e.density; // 1 - cos(cutoff)
      const Real drop = v1 * cap; // 2 sin^2 of half the angle to the axis
      const Real sine = sqrt(drop * (2.0f - drop));
      const Frame about_axis = frame_about(LIGHT_VEC3(scene, e.light, direction));
      direction = vec_select(spot, from_frame(about_axis, polar_direction(sine, 1.0f - drop, v2)), direction);
      const Real falloff = spot ? spot_falloff(scene, e.light, 2.0f * asin(sqrt(0.5f * drop))) : (Real)(1.0f);
      e.radiance = vec_scale(falloff, e.radiance);
    }
    const Ray ray = {LIGHT_VEC3(scene, e.light, position), direction};
    e.ray = select_ray(m, ray, e.ray);
  }
  if (HAS_DIRECTIONAL_LIGHTS)
    emit_from_infinity(scene, &e, LIGHT_VEC3(scene, e.light, direction), u1, u2, LIGHT_IS(kind, LIGHT_DIRECTIONAL));
  if (HAS_SKY) {
    e.sky = is_sky(kind);
    Vec3 direction;
    if (HAS_ENVIRONMENT_MAP) {
      const Vec3 to_sky = sample_environment(scene, aim);
      const Environment sky = environment_towards(scene, to_sky);
      direction = vec_scale((Real)(-1.0f), to_sky);
      e.sky_density = sky.density;
      e.density = emission_density(scene, e.light, sky.density);
      // Black if the density is 0 because of rounding: a weight of 0 / 0 would not be finite.
      const Vec3 radiance = vec_select(sky.density > 0.0f, sky.radiance, vec_all((Real)(0.0f)));
      e.radiance = vec_select(e.sky, radiance, e.radiance);
    } else {
      direction = sphere_direction(v1, v2);
    }
    emit_from_infinity(scene, &e, direction, u1, u2, e.sky);
  }
  return e;
}

#endif
