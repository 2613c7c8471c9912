// Light subpaths: how they leave a light, reflect, and are seen by the eye.
#ifndef PHLUX_LIGHT_WALK_CL
#define PHLUX_LIGHT_WALK_CL

#include "scene/camera.cl"
#include "scene/emission.cl"
#include "transport/shadow_queue.cl"
#include "transport/starts.cl"
#include "transport/walk.cl"

#define TECHNIQUE(light_vertices, eye_vertices) (((light_vertices) << 16) | (eye_vertices))

// A contribution to the pixel that sees it.
static inline Contribution splat(const Walk* walk, Int pixel, Vec3 value, Real weight, Int technique) {
  Contribution c;
  c.path = walk->path;
  c.pixel = pixel;
  c.own = IS_BIDIR ? (Mask)(pixel == uint_to_int(walk->sequence.pixel)) : NO_LANES;
  c.value = value;
  c.weight = weight;
  c.technique = technique;
  return c;
}

// The direction from the eye to a place, and where on the film that is.
typedef struct {
  Vec3 from_eye;
  Real distance2;
  FilmPoint film;
} View;

static inline View view_of(const Scene* scene, Vec3 position) {
  const Vec3 way = vec_sub(position, broadcast_vec(scene->camera->position));
  View view;
  view.distance2 = vec_dot(way, way);
  view.from_eye = vec_scale(1.0f / sqrt(view.distance2), way);
  view.film = camera_sees(scene, view.from_eye);
  return view;
}

// Connects the eye to the light's own point in the lanes of m.
static inline void show_light(const Scene* scene, const Walk* walk, Emission e, ShadowQueue* queue, Output* output,
                              Mask m) {
  if (!HAS_HITTABLE_LIGHTS) return;
  const Vec3 eye = broadcast_vec(scene->camera->position);
  View view = view_of(scene, e.origin.position);
  Real distance;
  Ray ray = ray_to_point(e.origin, eye, &distance);
  const Real cosine = -vec_dot(e.origin.normal, view.from_eye);
  Mask faces = e.surface & (cosine > 0.0f);
  Real chosen = PI * e.density * view.distance2 / cosine; // the density of the point, per solid angle at the eye
  if (HAS_CONSTANT_LIGHT) {
    const Vec3 from_eye = vec_scale((Real)(-1.0f), e.ray.direction);
    view.film = select_film(e.sky, camera_sees(scene, from_eye), view.film);
    ray.origin = vec_select(e.sky, eye, ray.origin);
    ray.direction = vec_select(e.sky, from_eye, ray.direction);
    distance = e.sky ? (Real)(INFINITY) : distance;
    faces = faces | e.sky;
    chosen = e.sky ? (0.25f * INV_PI) * light_probability(scene, e.light) : chosen;
  }
  const Mask seen = m & faces & view.film.seen;
  if (!any_lane(seen)) return;
  const Vec3 value = vec_scale(view.film.density / chosen, e.radiance);
  const Real weight = IS_BIDIR ? weight_of_seen_light(view.film.density, chosen) : (Real)(1.0f);
  add_if_free(scene, queue, output, ray, distance, splat(walk, view.film.pixel, value, weight, (Int)(TECHNIQUE(1, 1))),
              seen);
}

// The batch's next paths, one for each lane as long as there are any, before their first edge; returns the lanes that
// have one to be traced.
static inline Mask leave_light(const Scene* scene, JobList list, Batch* batch, WalkLimits limits, Walk* walk,
                               ShadowQueue* queue, Output* output, Mask* started) {
  const Mask starting = take_paths(batch, &walk->path, ALL_LANES);
  find_path(list, batch, walk->path, &walk->sequence);
  const Emission e = emission_sample(scene, random_words(walk->sequence, (Uint)(DIMENSION_EMISSION), 0),
                                     random_words(walk->sequence, (Uint)(DIMENSION_EMISSION + 1), 0));
  walk->ray = e.ray;
  walk->throughput = vec_scale(1.0f / e.density, e.radiance);
  walk->light = e.light;
  walk->light_cosine = vec_dot(e.origin.normal, e.ray.direction);
  const Mask shines = starting & (vec_max(e.radiance) > 0.0f);
  show_light(scene, walk, e, queue, output, shines);
  *started = starting;
  return limits.edges > 1 ? shines : NO_LANES;
}

// Connects the eye to the vertices of m.
static inline void show_vertex(const Scene* scene, const Walk* walk, Vertex v, ShadowQueue* queue, Output* output,
                               Mask m) {
  const View view = view_of(scene, v.point.position);
  const Vec3 to_eye = vec_scale((Real)(-1.0f), view.from_eye);
  const Vec3 generated = to_frame(v.point.frame, to_eye);
  const Real cosine = vec_dot(v.point.normal, to_eye);
  const Mask seen = m & view.film.seen & leaves(generated, cosine);
  if (!any_lane(seen)) return;
  const LobeValue lobe = material_evaluate(v.material, v.fixed, generated);
  const Vec3 reflected = vec_mul(walk->throughput, lobe.value);
  const Vec3 value = vec_scale(adjoint_cosine(v, generated, cosine) * view.film.density / view.distance2, reflected);
  Real weight = (Real)(1.0f);
  if (IS_BIDIR)
    weight = weight_of_seen_vertex(walk->ratios, view.film.density, lobe.reverse, view.distance2, cosine);
  Real distance;
  const Ray ray = ray_to_point(surface_position(v.point), broadcast_vec(scene->camera->position), &distance);
  add_if_free(scene, queue, output, ray, distance,
              splat(walk, view.film.pixel, value, weight, TECHNIQUE(walk->edges + 1, 1)), seen & brings_light(value));
}

#endif
