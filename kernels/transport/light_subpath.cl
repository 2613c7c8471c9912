// Light subpaths: how they start at a light, are scattered, and are connected to the camera. Light tracing and
// bidirectional path tracing share them; the latter weights the connections and stores the vertices.
#ifndef PHLUX_LIGHT_SUBPATH_CL
#define PHLUX_LIGHT_SUBPATH_CL

#include "scene/camera.cl"
#include "scene/emission.cl"
#include "transport/shadow_queue.cl"
#include "transport/vertex_store.cl"
#include "transport/waiting_subpaths.cl"

#define TECHNIQUE(light_vertices, eye_vertices) (((light_vertices) << 16) | (eye_vertices))

// What the stages of a work-item share.
typedef struct {
  const Scene* scene;
  JobList list;
  PathLimits limits;
  int sky_light;
  uint2 seed;
  ShadowQueue queue;
  Output output;
  VertexStore light, eye; // bidir
  uint rays;
} WorkItem;

// A contribution to the pixel that sees it.
static inline Contribution splat(const Subpath* s, Int pixel, Vec3 value, Real weight, Int technique) {
  Contribution c;
  c.path = s->path;
  c.pixel = pixel;
  c.own = IS_BIDIR ? (Mask)(pixel == uint_to_int(s->sequence.pixel)) : NO_LANES;
  c.value = value;
  c.weight = weight;
  c.technique = technique;
  return c;
}

// The direction from the camera to a position, and where on the film that is.
typedef struct {
  Vec3 from_camera;
  Real distance2;
  FilmPoint film;
} View;

static inline View view_of(const Scene* scene, Vec3 position) {
  const Vec3 to_position = vec_sub(position, broadcast_vec(scene->camera->position));
  View view;
  view.distance2 = vec_dot(to_position, to_position);
  view.from_camera = vec_scale(1.0f / sqrt(view.distance2), to_position);
  view.film = camera_sees(scene, view.from_camera);
  return view;
}

// Connects the camera to the light's own point (s = 1, t = 1) in the lanes of m.
static inline void connect_light_to_camera(WorkItem* work, const Subpath* s, Emission e, Mask m) {
  if (!HAS_HITTABLE_LIGHTS) return;
  const Scene* scene = work->scene;
  const Vec3 camera = broadcast_vec(scene->camera->position);
  View view = view_of(scene, e.origin.position);
  Real distance;
  Ray ray = ray_to_point(e.origin, camera, &distance);
  const Real cosine = -vec_dot(e.origin.normal, view.from_camera);
  Mask faces = e.surface & (cosine > 0.0f);
  Real density = PI * e.density * view.distance2 / cosine; // of the light's point, per solid angle at the camera
  if (HAS_CONSTANT_LIGHT) {
    const Vec3 from_camera = vec_scale((Real)(-1.0f), e.ray.direction);
    view.film = select_film(e.sky, camera_sees(scene, from_camera), view.film);
    ray.origin = vec_select(e.sky, camera, ray.origin);
    ray.direction = vec_select(e.sky, from_camera, ray.direction);
    distance = e.sky ? (Real)(INFINITY) : distance;
    faces = faces | e.sky;
    density = e.sky ? (0.25f * INV_PI) * light_probability(scene, e.light) : density;
  }
  const Mask seen = m & faces & view.film.seen;
  if (!any_lane(seen)) return;
  const Vec3 value = vec_scale(view.film.density / density, e.radiance);
  const Real weight = IS_BIDIR ? weight_of_seen_light(view.film.density, density) : (Real)(1.0f);
  add_if_unoccluded(scene, &work->queue, &work->output, ray, distance,
                    splat(s, view.film.pixel, value, weight, (Int)(TECHNIQUE(1, 1))), seen);
}

// Connects the camera to the vertices of m (t = 1; Dutre, Lafortune and Willems 1993).
static inline void connect_to_camera(WorkItem* work, const Subpath* s, Vertex v, Mask m) {
  const Scene* scene = work->scene;
  const View view = view_of(scene, v.point.position);
  const Vec3 to_camera = vec_scale((Real)(-1.0f), view.from_camera);
  const Vec3 generated = to_frame(v.point.frame, to_camera);
  const Real cosine = vec_dot(v.point.normal, to_camera);
  const Mask seen = m & view.film.seen & leaves(generated, cosine);
  if (!any_lane(seen)) return;
  const LobeValue lobe = material_evaluate(v.material, v.fixed, generated);
  const Vec3 reflected = vec_mul(s->throughput, lobe.value);
  const Vec3 value = vec_scale(adjoint_cosine(v, generated, cosine) * view.film.density / view.distance2, reflected);
  Real weight = (Real)(1.0f);
  if (IS_BIDIR) weight = weight_of_seen_vertex(s->mis, view.film.density, lobe.reverse, view.distance2, size_of_cosine(cosine));
  Real distance;
  const Ray ray = ray_to_point(surface_position(v.point), broadcast_vec(scene->camera->position), &distance);
  add_if_unoccluded(scene, &work->queue, &work->output, ray, distance,
                    splat(s, view.film.pixel, value, weight, TECHNIQUE(s->edges + 1, 1)), seen & brings_light(value));
}

// Samples the emission of the batch's next paths, one for each lane as long as there are any. Returns the lanes that
// have an edge to trace; *started: those that have a path.
static inline Mask start_at_light(WorkItem* work, Batch* batch, Subpath* s, Mask* started) {
  const Scene* scene = work->scene;
  *started = take_paths(batch, &s->path, ALL_LANES);
  find_path(work->list, batch, s->path, &s->sequence);
  const Emission e = emission_sample(scene, random_words(s->sequence, (Uint)(DIMENSION_EMISSION), 0),
                                     random_words(s->sequence, (Uint)(DIMENSION_EMISSION + 1), 0));
  s->ray = e.ray;
  s->throughput = vec_scale(1.0f / e.density, e.radiance);
  s->light = e.light;
  s->light_cosine = vec_dot(e.origin.normal, e.ray.direction);
  const Mask shines = *started & (vec_max(e.radiance) > 0.0f);
  connect_light_to_camera(work, s, e, shines);
  return work->limits.longest > 1 ? shines : NO_LANES;
}

// The density with which a light sample at the vertex would have found the point where the light subpath started,
// `distance` away, in the lanes of m; that of a light without a surface as in LightSample.
static inline Real density_of_start(const Scene* scene, const Subpath* s, Vertex v, Real distance, Mask m) {
  const Vec3 lit = v.point.position;
  const Real choice = probability_for(scene, lit, lit_normal(v.point), s->light, m);
  const Int kind = light_kind(scene, s->light);
  Real density = choice;
  if (HAS_AREA_LIGHTS) {
    const Mask surface = LIGHT_IS(kind, LIGHT_PLANAR) | LIGHT_IS(kind, LIGHT_SPHERE);
    density = surface ? light_density(scene, lit, s->light, choice, distance, s->light_cosine) : density;
  }
  if (HAS_POINTLIKE_LIGHTS) density = is_pointlike(kind) ? choice * distance * distance : density;
  if (HAS_CONSTANT_LIGHT) density = LIGHT_IS(kind, LIGHT_CONSTANT) ? choice * sky_sample_density(v.point, v.fixed.z) : density;
  return density;
}

// The quantities of a light subpath that has arrived at the vertex.
static inline MisQuantities mis_arrived_from_light(const Scene* scene, const Subpath* s, Vertex v, Real distance) {
  const Real cosine = -vec_dot(v.point.normal, s->ray.direction);
  const MisQuantities later = mis_arrived(s->mis, distance * distance, cosine);
  const Mask first = s->edges == 1;
  if (!any_lane(first)) return later;
  const MisQuantities start =
      mis_from_light(density_of_start(scene, s, v, distance, first), LIGHT_REAL(scene, s->light, emission_density),
                     cosine, is_hittable(light_kind(scene, s->light)));
  MisQuantities q;
  q.d_vcm = first ? start.d_vcm : later.d_vcm;
  q.d_vc = first ? start.d_vc : later.d_vc;
  return q;
}

// Traces the batch's light subpaths and connects them to the camera. Returns whether there was room for the vertices
// that bidirectional path tracing stores.
static inline int trace_light_subpaths(WorkItem* work, Batch batch) {
  const Scene* scene = work->scene;
  Subpath s = no_subpath(work->seed), next = no_subpath(work->seed);
  WaitingSubpaths waiting;
  waiting.count = 0;
  StoredSubpath stored = nothing_stored();
  Mask alive = NO_LANES;
  for (int row = 0;; ++row) {
    const Mask idle = !alive;
    while (wants_subpaths(&waiting, &batch, count_lanes(idle))) {
      Mask started;
      const Mask shines = start_at_light(work, &batch, &next, &started);
      put_subpaths(&waiting, &next, shines);
      if (IS_BIDIR) set_stored(&work->light, next.path, nothing_stored(), started & !shines);
    }
    const Mask starting = take_subpaths(&waiting, &s, idle);
    alive |= starting;
    if (!any_lane(alive)) return 1;
    if (IS_BIDIR && row == work->light.rows) return 0;

    const Mask tracing = alive;
    const Arrival arrival = next_vertex(scene, &s, work->limits, tracing);
    work->rays += (uint)count_lanes(tracing);
    if (IS_BIDIR) {
      s.mis = mis_arrived_from_light(scene, &s, arrival.vertex, arrival.distance);
      store_vertices(&work->light, row, &s, arrival.vertex, &stored, starting, arrival.scattered);
    }
    connect_to_camera(work, &s, arrival.vertex, arrival.scattered);
    MaterialSample sample;
    alive = scatter(&s, arrival.vertex, 1, DIMENSION_LIGHT_SCATTERING(s.edges), work->limits, &sample,
                    arrival.scattered & (s.edges + 1 < work->limits.longest));
    if (IS_BIDIR) set_stored(&work->light, s.path, stored, tracing & !alive);
  }
}

#endif
