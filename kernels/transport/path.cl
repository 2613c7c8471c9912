// Path tracing (CW 197, 3.3.2): from the eye, reflecting at every surface, until roulette, the depth or the dark ends
// the path. What reaches the lights: hits alone, light samples, or both with weights (CONNECT).
#include "scene/camera.cl"
#include "transport/film.cl"
#include "scene/lights.cl"
#include "lobes/material.cl"
#include "math/random.h"
#include "scene/surface.cl"
#include "scene/traverse.cl"
#include "transport/walk.cl"

// The path that each lane is on.
typedef struct {
  Ray ray;
  Vec3 throughput, radiance;
  Int edges;        // of the path so far
  Vec3 normal;      // of the surface where the ray starts
  Real density;     // of ray.direction, per solid angle where the ray starts
  Mask delta;       // ray.direction was sampled from a delta distribution
  Real sky_density; // with which light_sample chooses that direction for a constant light
  RandomSequence sequence;
} Path;

static inline Path no_path(uint2 seed) {
  Path path;
  path.ray.origin = path.ray.direction = path.throughput = path.radiance = path.normal = vec_all((Real)(0.0f));
  path.edges = (Int)(0);
  path.density = path.sky_density = (Real)(0.0f);
  path.delta = NO_LANES;
  path.sequence.pixel = path.sequence.sample = (Uint)(0u);
  path.sequence.seed = seed;
  return path;
}

// Starts the lanes of `starting` on their jobs' next samples.
static inline void start_path(const Scene* scene, Path* path, JobList list, Job job, Mask starting) {
  RandomSequence sequence;
  sequence.pixel = int_to_uint(job.pixel);
  sequence.sample = int_to_uint(sample_number(list, job));
  sequence.seed = path->sequence.seed;
  const RandomWords words = random_words(sequence, (Uint)(0), 0);
  const Ray ray = camera_ray(scene, sequence.pixel, uniform_real(words.x), uniform_real(words.y));
  path->ray.origin = vec_select(starting, ray.origin, path->ray.origin);
  path->ray.direction = vec_select(starting, ray.direction, path->ray.direction);
  path->throughput = vec_select(starting, vec_all((Real)(1.0f)), path->throughput);
  path->radiance = vec_select(starting, vec_all((Real)(0.0f)), path->radiance);
  path->edges = starting ? (Int)(0) : path->edges;
  path->delta = path->delta & !starting;
  path->sequence.pixel = starting ? sequence.pixel : path->sequence.pixel;
  path->sequence.sample = starting ? sequence.sample : path->sequence.sample;
}

// Lanes where a light sample at the vertex before could have found the point that the ray hits: there was a vertex, and
// its event was no delta event.
static inline Mask light_sampled(const Path* path) {
  const Mask reflected = path->edges > 1;
  return HAS_DELTA ? reflected & !path->delta : reflected;
}

// Adds what a hit light sends along the ray in the lanes of m, weighted against light_sample.
static inline void add_emission(const Scene* scene, Path* path, Hit hit, SurfacePoint point, Mask m) {
  if (!HAS_AREA_LIGHTS) return;
  const Mask emits = m & point.front & (point.light >= 0);
  if (!any_lane(emits)) return;
  const Int light = max(point.light, (Int)(0));
  Vec3 arriving = vec_mul(path->throughput, LIGHT_VEC3(scene, light, radiance));
  const Mask counts = CONNECT == CONNECT_LIGHT ? emits & !light_sampled(path) : emits;
  if (CONNECT == CONNECT_MIS) {
    const Real cosine = -vec_dot(point.normal, path->ray.direction);
    const Mask sampled = emits & light_sampled(path);
    const Real choice = probability_for(scene, path->ray.origin, path->normal, light, sampled);
    const Real other = light_density(scene, path->ray.origin, light, choice, hit.distance, cosine);
    const Real weight = sampled ? path->density / (path->density + other) : (Real)(1.0f);
    arriving = vec_scale(weight, arriving);
  }
  path->radiance = vec_select(counts, vec_add(path->radiance, arriving), path->radiance);
}

// Adds the constant light in the lanes of m, whose rays left the scene.
static inline void add_sky(const Scene* scene, Path* path, Mask m, int sky_light) {
  if (!HAS_CONSTANT_LIGHT) return;
  const __global LightRecord* sky = scene->lights + sky_light;
  Vec3 arriving = vec_mul(path->throughput, broadcast_vec(sky->radiance));
  const Mask counts = CONNECT == CONNECT_LIGHT ? m & !light_sampled(path) : m;
  if (CONNECT == CONNECT_MIS) {
    const Real other = sky->probability * path->sky_density;
    const Real weight = light_sampled(path) ? path->density / (path->density + other) : (Real)(1.0f);
    arriving = vec_scale(weight, arriving);
  }
  path->radiance = vec_select(counts, vec_add(path->radiance, arriving), path->radiance);
}

// Adds one light sample in the lanes of m; returns the lanes that sent a shadow ray.
static inline Mask add_light_sample(const Scene* scene, Path* path, Vertex v, Mask m) {
  const RandomWords words = random_words(path->sequence, DIMENSION_LIGHT(path->edges), 0);
  const LightSample light = light_sample(scene, v.point, words);
  const Vec3 generated = to_frame(v.point.frame, light.ray.direction);
  Mask reaches = m & light.valid & leaves(generated, vec_dot(v.point.normal, light.ray.direction));
  if (!any_lane(reaches)) return reaches;
  const LobeValue lobe = material_evaluate(v.material, v.fixed, generated);
  if (HAS_DELTA) reaches &= vec_max(lobe.value) > 0.0f;
  const Mask lit = reaches & !scene_occluded(scene, light.ray, light.distance, reaches);
  const Vec3 reflected = vec_mul(path->throughput, lobe.value);
  Vec3 arriving = vec_scale(generated.z / light.density, vec_mul(light.radiance, reflected));
  if (CONNECT == CONNECT_MIS && HAS_HITTABLE_LIGHTS) {
    const Real weight = light.hittable ? light.density / (light.density + lobe.density) : (Real)(1.0f);
    arriving = vec_scale(weight, arriving);
  }
  path->radiance = vec_select(lit, vec_add(path->radiance, arriving), path->radiance);
  return reaches;
}

// Reflects the paths of m; returns those that go on: not absorbed by roulette, and above the surface.
static inline Mask reflect(Path* path, Vertex v, int roulette_edges, float ambient, Mask m) {
  const RandomDraws random = random_draws(path->sequence, DIMENSION_REFLECTION(path->edges));
  const MaterialSample sample = material_sample(v.material, v.fixed, random, path->edges >= roulette_edges, m);
  const Vec3 direction = from_frame(v.point.frame, sample.direction);
  const Mask goes_on = m & sample.survives & leaves(sample.direction, vec_dot(v.point.normal, direction));
  if (HAS_AMBIENT) {
    // Light of radiance `ambient` from everywhere, reflected for certain less as sampled: 0 on average.
    const Vec3 sampled = vec_select(sample.survives, sample.weight, vec_all((Real)(0.0f)));
    const Vec3 difference = vec_sub(material_reflectivity(v.material, v.fixed), sampled);
    const Vec3 variate = vec_scale((Real)(ambient), vec_mul(path->throughput, difference));
    path->radiance = vec_select(m, vec_add(path->radiance, variate), path->radiance);
  }
  path->throughput = vec_select(goes_on, vec_mul(path->throughput, sample.weight), path->throughput);
  path->normal = v.point.normal;
  path->density = sample.density;
  path->delta = sample.delta;
  path->sky_density = sample.direction.z * INV_PI;
  path->ray.origin = offset_origin(v.point.position, v.point.normal, v.point.error, direction);
  path->ray.direction = direction;
  return goes_on & (vec_max(path->throughput) > 0.0f);
}

__kernel void trace_paths(SCENE_PARAMETERS, int pixel_count, int first_pixel, int job_count, int first_sample,
                          int block_samples, uint2 seed, int max_edges, int roulette_edges, __global uint* counters,
                          int sky_light, float ambient, __global float* sums) {
  SCENE_FROM_PARAMETERS
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples};
  Job job = first_job(list);
  Path path = no_path(seed);
  Uint rays = (Uint)(0u), shadow_rays = (Uint)(0u);
  Mask alive = NO_LANES;

  for (Mask working = jobs_left(list, job); any_lane(working); working = jobs_left(list, job)) {
    const Mask starting = working & !alive;
    if (any_lane(starting)) start_path(&scene, &path, list, job, starting);
    alive = working;

    const Hit hit = scene_intersect(&scene, path.ray, alive);
    rays += alive ? (Uint)(1u) : (Uint)(0u);
    path.edges += alive ? (Int)(1) : (Int)(0);
    const Mask hits = alive & (hit.primitive >= 0);
    add_sky(&scene, &path, alive & !hits, sky_light);
    const SurfacePoint point = surface_point(&scene, path.ray, hit);
    add_emission(&scene, &path, hit, point, hits);

    const Vertex vertex = vertex_at(&scene, path.ray, point);
    const Mask reflecting = hits & (path.edges < max_edges) & can_reflect(&scene, vertex);
    if (CONNECT != CONNECT_NONE) {
      const Mask asked = add_light_sample(&scene, &path, vertex, reflecting);
      shadow_rays += asked ? (Uint)(1u) : (Uint)(0u);
    }
    alive = reflect(&path, vertex, roulette_edges, ambient, reflecting);

    const Mask ended = working & !alive;
    if (any_lane(ended)) add_sample(list, &job, path.radiance, sums, ended);
  }
  const int item = (int)get_global_id(0) * 2;
  counters[item] = sum_of_lanes(rays);
  counters[item + 1] = sum_of_lanes(shadow_rays);
}
