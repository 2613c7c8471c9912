// Eye subpaths: their start at the camera, and the light that they find by hits and by light samples. Path tracing and
// bidirectional path tracing share this code; only the weights differ.
#ifndef PHLUX_EYE_SUBPATH_CL
#define PHLUX_EYE_SUBPATH_CL

#include "scene/camera.cl"
#include "scene/lights.cl"
#include "transport/subpath.cl"

// Starts a subpath at the camera for its pixel and sample, in all lanes.
static inline void start_at_camera(const Scene* scene, Subpath* s) {
  const CameraSample sample = camera_sample(scene, random_words(s->sequence, (Uint)(0), 0));
  s->ray = camera_ray(scene, s->sequence.pixel, sample);
  s->throughput = vec_all((Real)(1.0f));
  s->unattenuated = (Real)(1.0f);
  s->edges = (Int)(0);
  s->delta = NO_LANES;
  if (IS_BIDIR)
    s->mis = mis_from_eye(film_density(scene, vec_dot(s->ray.direction, broadcast_vec(scene->camera->forward))));
}

// Radiance that arrives at the camera along a path: value x weight, in the lanes of `found`.
typedef struct {
  Vec3 value;
  Real weight;
  Mask found;
} FoundLight;

// The length that converts the density of an edge per solid angle to one per area: that of the edge; 1 for the first
// edge from an orthographic camera, whose density is per area perpendicular to its parallel rays.
static inline Real edge_length(const Subpath* s, Real distance) {
  if (!HAS_ORTHOGRAPHIC) return distance;
  return s->edges == 1 ? (Real)(1.0f) : distance;
}

// Lanes in which a light sample at the previous vertex could have found what the ray hits: there is a previous vertex,
// and its event was not a delta event.
static inline Mask light_sample_possible(const Subpath* s) {
  const Mask scattered = s->edges > 1;
  return HAS_DELTA ? scattered & !s->delta : scattered;
}

// The weight of hitting a light (s = 0). `light_sample` is the density with which a light sample at the previous vertex
// would have found the point; `from_camera` is that density for the first edge, where a light path is connected to the
// camera instead.
static inline Real weight_of_hit_light(const Subpath* s, Real light_sample, Real from_camera, Real emission) {
  if (IS_BIDIR) return weight_of_hit(s->mis, s->edges == 1 ? from_camera : light_sample, emission);
  if (CONNECT != CONNECT_MIS) return (Real)(1.0f);
  const Mask found_twice = light_sample_possible(s) & (light_sample > 0.0f);
  return found_twice ? s->density / (s->density + light_sample) : (Real)(1.0f);
}

// Lanes of m whose hits count: those that may show lights; with CONNECT_LIGHT only where no light sample is possible.
static inline Mask hits_count(const Subpath* s, Mask m) {
  if (HAS_HIDDEN_EMITTERS) m &= s->edges > 1;
  const int light_samples_alone = !IS_BIDIR & (CONNECT == CONNECT_LIGHT);
  return light_samples_alone ? m & !light_sample_possible(s) : m;
}

// The light that the subpaths of m have hit.
static inline FoundLight hit_light(const Scene* scene, const Subpath* s, SurfacePoint point, Real distance, Mask m) {
  FoundLight found;
  found.value = vec_all((Real)(0.0f));
  found.weight = (Real)(1.0f);
  found.found = NO_LANES;
  if (!HAS_AREA_LIGHTS) return found;
  const Mask emits = m & point.front & (point.light >= 0);
  if (!any_lane(emits)) return found;
  const Int light = max(point.light, (Int)(0));
  const Real cosine = -vec_dot(point.normal, s->ray.direction);
  const Real emission = LIGHT_REAL(scene, light, emission_density);
  const Real choice = probability_for(scene, s->ray.origin, s->normal, light, emits & light_sample_possible(s));
  const Real light_sample = light_density(scene, s->ray.origin, light, choice, distance, cosine);
  found.value = vec_mul(s->throughput, LIGHT_VEC3(scene, light, radiance));
  const Real length = edge_length(s, distance);
  found.weight = weight_of_hit_light(s, light_sample, PI * emission * length * length / cosine, emission);
  found.found = hits_count(s, emits);
  return found;
}

// The sky, for the subpaths of m whose rays left the scene.
static inline FoundLight hit_sky(const Scene* scene, const Subpath* s, Mask m) {
  FoundLight found;
  const __global LightRecord* sky = scene->lights + sky_light(scene);
  Vec3 radiance = broadcast_vec(sky->radiance);
  Real sampled = s->sky_sample_density, emitted = (Real)(0.25f * INV_PI), emission = (Real)(sky->emission_density);
  if (HAS_ENVIRONMENT_MAP) {
    const Environment here = environment_towards(scene, s->ray.direction);
    radiance = here.radiance;
    sampled = emitted = here.density;
    emission *= here.density;
  }
  if (HAS_ORTHOGRAPHIC) emitted = (Real)(0.0f); // no emitted ray has exactly the direction of the camera rays
  found.value = vec_mul(s->throughput, radiance);
  const Real light_sample = HAS_SKY_SAMPLES ? sky->sample_probability * sampled : (Real)(0.0f);
  found.weight = weight_of_hit_light(s, light_sample, emitted * sky->probability, emission);
  found.found = hits_count(s, m);
  return found;
}

// The weight of a light sample (s = 1).
static inline Real weight_of_sampled_light(const Scene* scene, const Subpath* s, LightSample light, LobeValue lobe,
                                           Real cosine) {
  if (IS_BIDIR)
    return weight_of_light_sample(s->mis, light.density,
                                  emission_density(scene, light.light, light.density / light.choice), lobe.density,
                                  lobe.reverse, cosine, light.hittable);
  if ((CONNECT != CONNECT_MIS) | !HAS_HITTABLE_LIGHTS) return (Real)(1.0f);
  return light.hittable ? light.density / (light.density + lobe.density) : (Real)(1.0f);
}

// Draws a light sample at the vertices of m. Returns the lanes in which light arrives and may be scattered, if
// light->ray is unoccluded before light->distance.
static inline Mask draw_light(const Scene* scene, const Subpath* s, Vertex v, LightSample* light, Mask m) {
  *light = light_sample(scene, v.point, random_draws(s->sequence, DIMENSION_LIGHT_SAMPLE(s->edges)));
  const Vec3 generated = to_frame(v.point.frame, light->ray.direction);
  Mask reaches = m & light->valid & leaves(generated, vec_dot(v.point.normal, light->ray.direction));
  if (HAS_DELTA) reaches &= vec_max(material_evaluate(v.material, v.fixed, generated).value) > 0.0f;
  return reaches;
}

// The light of the sample that draw_light drew, in the lanes of m.
static inline FoundLight sampled_light(const Scene* scene, const Subpath* s, Vertex v, LightSample light, Mask m) {
  const Vec3 generated = to_frame(v.point.frame, light.ray.direction);
  const Real cosine = vec_dot(v.point.normal, light.ray.direction);
  const LobeValue lobe = material_evaluate(v.material, v.fixed, generated);
  const Vec3 scattered = vec_mul(s->throughput, lobe.value);
  FoundLight found;
  found.value = vec_scale(abs_cosine(generated.z) / light.density, vec_mul(light.radiance, scattered));
  found.value = vec_scale(radiance_scale(v.material, generated), found.value);
  found.weight = weight_of_sampled_light(scene, s, light, lobe, abs_cosine(cosine));
  found.found = m;
  return found;
}

#endif
