// Light subpaths: their start at a light, scattering, and connections to the camera. Light tracing and bidirectional
// path tracing share this code; the latter weights the connections and stores the vertices.
#ifndef PHLUX_LIGHT_SUBPATH_CL
#define PHLUX_LIGHT_SUBPATH_CL

#include "scene/camera.cl"
#include "scene/emission.cl"
#include "transport/shadow_queue.cl"
#include "transport/vertex_store.cl"
#include "transport/waiting_subpaths.cl"

#define TECHNIQUE(light_vertices, eye_vertices) (((light_vertices) << 16) | (eye_vertices))

// Data that the stages of a work-item share.
typedef struct {
  const Scene* scene;
  JobList list;
  PathLimits limits;
  int sky_light;
  uint2 seed;
  PointSets sets;
  ShadowQueue queue;
  Output output;
  VertexStore light, eye; // bidir
  uint rays;
} WorkItem;

// A contribution to the pixel in which the camera sees the vertex.
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

// The random words of the connection of the vertex after `edges` edges to the camera.
static inline RandomWords splat_words(const Subpath* s, Int edges) {
  return random_words(s->sequence, DIMENSION_SPLAT(edges), 0);
}

// The point of the lens to which that vertex is connected, and the offset of its splat.
static inline CameraSample splat_sample(const Scene* scene, const Subpath* s, Int edges) {
  CameraSample none;
  none.x = none.y = none.lens_x = none.lens_y = (Real)(0.0f);
  return HAS_CAMERA_SAMPLE ? camera_sample(scene, splat_words(s, edges)) : none;
}

// A pixel of the image, uniformly. Rows and columns are chosen separately, because one word is too short for the pixels
// of a large image.
static inline Uint uniform_pixel(const __global CameraRecord* camera, RandomWords words) {
  const Uint row = mul_hi(words.z, (Uint)((uint)camera->height));
  return row * (uint)camera->width + mul_hi(words.w, (Uint)((uint)camera->width));
}

// Connects the camera to the point at infinity in the lanes of `sky`. An orthographic camera sees the sky in a single
// direction, which no emitted ray has. In light tracing the ray of a random pixel is used instead (the words z and w of
// the sample are free, as there is no lens); in bidirectional path tracing the sky is found by hits.
static inline void see_sky(const Scene* scene, const Subpath* s, Emission* e, CameraSample sample, View* view, Ray* ray,
                           Real* density, Mask sky) {
  Vec3 from_camera = vec_scale((Real)(-1.0f), e->ray.direction);
  Vec3 eye = lens_position(scene, sample);
  FilmPoint film = camera_sees(scene, from_camera, sample);
  Real sky_density = e->sky_density;
  if (HAS_ORTHOGRAPHIC) {
    const Uint pixel = uniform_pixel(scene->camera, splat_words(s, (Int)(0)));
    const Ray towards_sky = camera_ray(scene, pixel, sample);
    eye = towards_sky.origin;
    from_camera = towards_sky.direction;
    film.seen = IS_BIDIR ? NO_LANES : ALL_LANES;
    film.pixel = uint_to_int(pixel);
    film.share = (Real)(1.0f);
    sky_density = film.density;
    if (HAS_ENVIRONMENT_MAP)
      e->radiance = vec_select(sky, environment_towards(scene, from_camera).radiance, e->radiance);
  }
  view->film = select_film(sky, film, view->film);
  ray->origin = vec_select(sky, eye, ray->origin);
  ray->direction = vec_select(sky, from_camera, ray->direction);
  *density = sky ? sky_density * LIGHT_REAL(scene, e->light, probability) : *density;
}

// Connects the camera to the point on the light itself (s = 1, t = 1) in the lanes of m.
static inline void connect_light_to_camera(WorkItem* work, const Subpath* s, Emission e, Mask m) {
  if (!HAS_HITTABLE_LIGHTS | HAS_HIDDEN_EMITTERS) return;
  const Scene* scene = work->scene;
  const CameraSample sample = splat_sample(scene, s, (Int)(0));
  View view = view_of(scene, e.origin.position, sample);
  Real distance;
  Ray ray = ray_to_point(e.origin, view.eye, &distance);
  const Real cosine = -vec_dot(e.origin.normal, view.from_camera);
  Mask faces = e.surface & (cosine > 0.0f);
  Real density = PI * e.density * view.distance2 / cosine; // of the light's point, per solid angle at the camera
  if (HAS_SKY) {
    see_sky(scene, s, &e, sample, &view, &ray, &density, e.sky);
    distance = e.sky ? (Real)(INFINITY) : distance;
    faces = faces | e.sky;
  }
  const Mask seen = m & faces & view.film.seen;
  if (!any_lane(seen)) return;
  const Real seen_share = view.film.density / density;
  const Vec3 value = vec_scale(HAS_FILTER ? view.film.share * seen_share : seen_share, e.radiance);
  const Real weight = IS_BIDIR ? weight_of_seen_light(view.film.density, density) : (Real)(1.0f);
  add_if_unoccluded(scene, &work->queue, &work->output, ray, distance,
                    splat(s, view.film.pixel, value, weight, (Int)(TECHNIQUE(1, 1))), seen);
}

// Connects the camera to the vertices of m (t = 1; Dutre, Lafortune and Willems 1993).
static inline void connect_to_camera(WorkItem* work, const Subpath* s, Vertex v, Mask m) {
  const Scene* scene = work->scene;
  const View view = view_of(scene, v.point.position, splat_sample(scene, s, s->edges));
  const Vec3 to_camera = vec_scale((Real)(-1.0f), view.from_camera);
  const Vec3 generated = to_frame(v.point.frame, to_camera);
  const Real cosine = vec_dot(v.point.normal, to_camera);
  const Mask seen = m & view.film.seen & leaves(generated, cosine);
  if (!any_lane(seen)) return;
  const LobeValue lobe = material_evaluate(v.material, v.fixed, generated);
  const Vec3 reflected = vec_mul(s->throughput, lobe.value);
  const Real arriving = adjoint_cosine(v, generated, cosine) * view.film.density / view.distance2;
  const Vec3 value = vec_scale(HAS_FILTER ? view.film.share * arriving : arriving, reflected);
  Real weight = (Real)(1.0f);
  if (IS_BIDIR)
    weight = weight_of_seen_vertex(s->mis, view.film.density, lobe.reverse, view.distance2, abs_cosine(cosine));
  Real distance;
  const Ray ray = ray_to_point(surface_position(v.point), view.eye, &distance);
  add_if_unoccluded(scene, &work->queue, &work->output, ray, distance,
                    splat(s, view.film.pixel, value, weight, TECHNIQUE(s->edges + 1, 1)), seen & brings_light(value));
}

// Samples the emission of the next paths of the batch, one for each lane as long as there are any. Returns the lanes
// that have an edge to trace; *started: the lanes that have a path.
static inline Mask start_at_light(WorkItem* work, Batch* batch, Subpath* s, Mask* started) {
  const Scene* scene = work->scene;
  *started = take_paths(batch, &s->path, ALL_LANES);
  find_path(work->list, batch, s->path, &s->sequence);
  const Emission e = emission_sample(scene, random_words(s->sequence, (Uint)(DIMENSION_EMISSION), 0),
                                     random_words(s->sequence, (Uint)(DIMENSION_EMISSION + 1), 0));
  s->ray = e.ray;
  s->throughput = vec_scale(1.0f / e.density, e.radiance);
  s->unattenuated = vec_max(s->throughput);
  s->light = e.light;
  s->light_cosine = vec_dot(e.origin.normal, e.ray.direction);
  if (HAS_ENVIRONMENT_MAP) s->light_cosine = e.sky ? e.sky_density : s->light_cosine;
  const Mask shines = *started & (vec_max(e.radiance) > 0.0f);
  connect_light_to_camera(work, s, e, shines);
  return work->limits.longest > 1 ? shines : NO_LANES;
}

// The density with which a light sample at the vertex would have found the start of the light subpath, at `distance`,
// in the lanes of m. For a light without a surface as in LightSample.
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
  if (HAS_SKY_SAMPLES) {
    const Real by_sky =
        HAS_ENVIRONMENT_MAP ? choice * s->light_cosine : choice * sky_sample_density(v.point, v.fixed.z);
    density = is_sky(kind) ? by_sky : density;
  }
  return density;
}

// The MIS quantities of a light subpath that has arrived at the vertex.
static inline MisQuantities mis_arrived_from_light(const Scene* scene, const Subpath* s, Vertex v, Real distance) {
  const Real cosine = -vec_dot(v.point.normal, s->ray.direction);
  const MisQuantities later = mis_arrived(s->mis, distance * distance, cosine);
  const Mask first = s->edges == 1;
  if (!any_lane(first)) return later;
  const MisQuantities start =
      mis_from_light(density_of_start(scene, s, v, distance, first), emission_density(scene, s->light, s->light_cosine),
                     cosine, is_hittable(light_kind(scene, s->light)));
  MisQuantities q;
  q.d_vcm = first ? start.d_vcm : later.d_vcm;
  q.d_vc = first ? start.d_vc : later.d_vc;
  return q;
}

// Traces the light subpaths of the batch and connects them to the camera. Returns whether there was room for the
// vertices that bidirectional path tracing stores.
static inline int trace_light_subpaths(WorkItem* work, Batch batch) {
  const Scene* scene = work->scene;
  Subpath s = no_subpath(work->seed, work->sets), next = s;
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
    const Arrival arrival = next_vertex(scene, &s, 1, work->limits, tracing);
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
