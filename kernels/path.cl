// Path tracing (CW 197, 3.3.2): from the eye, reflecting at every surface, until roulette, the depth or the dark ends
// the path. What reaches the lights: hits alone, light samples, or both with weights (PHLUX_CONNECT).
#include "camera.cl"
#include "film.cl"
#include "lights.cl"
#include "material.cl"
#include "random.h"
#include "surface.cl"
#include "traverse.cl"

// Purposes of random words: dimension 0 is the place in the pixel, then two for every edge.
#define DIMENSION_REFLECTION(edges) (2 * (edges))
#define DIMENSION_LIGHT(edges) (2 * (edges) + 1)

// The path that each lane is on.
typedef struct {
  Ray ray;
  Vec3 throughput, radiance;
  Int edges;        // of the path so far
  Real density;     // of ray.direction, per solid angle where the ray starts
  Real sky_density; // with which light_sample chooses that direction for a constant light
  RandomSequence sequence;
} Path;

static inline Path no_path(uint2 seed) {
  Path path;
  path.ray.origin = path.ray.direction = path.throughput = path.radiance = vec_all((Real)(0.0f));
  path.edges = (Int)(0);
  path.density = path.sky_density = (Real)(0.0f);
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
  path->sequence.pixel = starting ? sequence.pixel : path->sequence.pixel;
  path->sequence.sample = starting ? sequence.sample : path->sequence.sample;
}

// Adds what a hit light sends along the ray in the lanes of m, weighted against light_sample.
static inline void add_emission(const Scene* scene, Path* path, Hit hit, SurfacePoint point, Mask m) {
#ifdef PHLUX_EMISSION
  const Mask emits = m & point.front & (point.light >= 0);
  if (!any_lane(emits)) return;
  const Int light = max(point.light, (Int)(0));
  Vec3 arriving = vec_mul(path->throughput, GATHER_VEC3(scene->lights, light, power));
#if PHLUX_CONNECT == CONNECT_LIGHT
  const Mask counts = emits & (path->edges == 1);
#else
  const Mask counts = emits;
#endif
#if PHLUX_CONNECT == CONNECT_MIS
  const Real other = light_density_of_hit(scene, path->ray.origin, path->ray, hit.distance, point, light);
  const Real weight = path->edges == 1 ? (Real)(1.0f) : path->density / (path->density + other);
  arriving = vec_scale(weight, arriving);
#endif
  path->radiance = vec_select(counts, vec_add(path->radiance, arriving), path->radiance);
#endif
}

// Adds the constant light in the lanes of m, whose rays left the scene.
static inline void add_sky(Path* path, Mask m, float4 sky, float sky_choice) {
#ifdef PHLUX_LIGHT_CONSTANT
  Vec3 arriving = vec_mul(path->throughput, vec3((Real)(sky.x), (Real)(sky.y), (Real)(sky.z)));
#if PHLUX_CONNECT == CONNECT_LIGHT
  const Mask counts = m & (path->edges == 1);
#else
  const Mask counts = m;
#endif
#if PHLUX_CONNECT == CONNECT_MIS
  const Real weight =
      path->edges == 1 ? (Real)(1.0f) : path->density / (path->density + sky_choice * path->sky_density);
  arriving = vec_scale(weight, arriving);
#endif
  path->radiance = vec_select(counts, vec_add(path->radiance, arriving), path->radiance);
#endif
}

#if PHLUX_CONNECT != CONNECT_NONE
// Adds one light sample in the lanes of m; returns the lanes that sent a shadow ray.
static inline Mask add_light_sample(const Scene* scene, Path* path, SurfacePoint point, Material material, Vec3 fixed,
                                    Mask m) {
  const RandomWords words = random_words(path->sequence, int_to_uint(DIMENSION_LIGHT(path->edges)), 0);
  const LightSample light = light_sample(scene, point, words);
  const Vec3 generated = to_frame(point.frame, light.ray.direction);
  // Both normals must agree that the light is on this side: nothing shines through.
  const Mask reaches = m & light.valid & (generated.z > 0.0f) & (vec_dot(point.normal, light.ray.direction) > 0.0f);
  if (!any_lane(reaches)) return reaches;
  const Mask lit = reaches & !scene_occluded(scene, light.ray, light.distance, reaches);
  Vec3 arriving =
      vec_scale(generated.z / light.density,
                vec_mul(light.radiance, vec_mul(path->throughput, material_eval(material, fixed, generated))));
#if PHLUX_CONNECT == CONNECT_MIS && defined(PHLUX_HITTABLE_LIGHTS)
  const Real other = material_density(material, fixed, generated);
  arriving = vec_scale(light.hittable ? light.density / (light.density + other) : (Real)(1.0f), arriving);
#endif
  path->radiance = vec_select(lit, vec_add(path->radiance, arriving), path->radiance);
  return reaches;
}
#endif

// Reflects the paths of m; returns those that go on: not absorbed by roulette, and above the surface.
static inline Mask reflect(Path* path, SurfacePoint point, Material material, Vec3 fixed, int roulette_edges,
                           float ambient, Mask m) {
  const PhongSample sample =
      material_sample(material, fixed, path->sequence, int_to_uint(DIMENSION_REFLECTION(path->edges)),
                      path->edges >= roulette_edges, m);
  const Vec3 direction = from_frame(point.frame, sample.direction);
  const Mask goes_on = m & sample.survives & (sample.direction.z > 0.0f) & (vec_dot(point.normal, direction) > 0.0f);
#ifdef PHLUX_AMBIENT
  // Light of radiance `ambient` from everywhere, reflected for certain less as sampled: 0 on average.
  const Vec3 sampled = vec_select(sample.survives, sample.weight, vec_all((Real)(0.0f)));
  const Vec3 difference = vec_sub(phong_reflectivity(material.phong, fixed.z), sampled);
  const Vec3 variate = vec_scale((Real)(ambient), vec_mul(path->throughput, difference));
  path->radiance = vec_select(m, vec_add(path->radiance, variate), path->radiance);
#endif
  path->throughput = vec_select(goes_on, vec_mul(path->throughput, sample.weight), path->throughput);
  path->density = sample.density;
  path->sky_density = sample.direction.z * PHONG_INV_PI;
  path->ray.origin = step_off(point.position, point.normal, point.error, direction);
  path->ray.direction = direction;
  return goes_on & (vec_max(path->throughput) > 0.0f);
}

__kernel void trace_paths(SCENE_PARAMETERS, int pixel_count, int first_pixel, int job_count, int first_sample,
                          int block_samples, int end_sample, uint2 seed, int max_edges, int roulette_edges, float4 sky,
                          float sky_choice, float ambient, __global float* sums, __global uint* counters) {
  SCENE_FROM_PARAMETERS
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples, end_sample};
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
    add_sky(&path, alive & !hits, sky, sky_choice);
    const SurfacePoint point = surface_point(&scene, path.ray, hit);
    add_emission(&scene, &path, hit, point, hits);

    const Material material = material_at(&scene, point.material);
    const Vec3 fixed = to_frame(point.frame, vec_scale((Real)(-1.0f), path.ray.direction));
    const Mask reflecting =
        hits & (path.edges < max_edges) & (fixed.z > 0.0f) & reflects(&scene, point.material, point.front);
#if PHLUX_CONNECT != CONNECT_NONE
    const Mask asked = add_light_sample(&scene, &path, point, material, fixed, reflecting);
    shadow_rays += asked ? (Uint)(1u) : (Uint)(0u);
#endif
    alive = reflect(&path, point, material, fixed, roulette_edges, ambient, reflecting);

    const Mask ended = working & !alive;
    if (any_lane(ended)) add_sample(list, &job, path.radiance, sums, ended);
  }
  const int item = (int)get_global_id(0) * 3;
  counters[item] = sum_of_lanes(rays);
  counters[item + 1] = sum_of_lanes(shadow_rays);
  counters[item + 2] = sum_of_lanes(job.nonfinite);
}
