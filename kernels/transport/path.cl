// Path tracing (Kajiya, The Rendering Equation, 1986): a path starts at the camera and is scattered at every surface,
// until it leaves the scene or is ended by roulette or the largest depth. CONNECT selects how light is found: by hits,
// by light samples, or by both with weights (Veach 1997, 9.2).
#include "transport/camera_packets.cl"
#include "transport/eye_subpath.cl"
#include "transport/film.cl"

static inline Vec3 add_found(Vec3 radiance, FoundLight light) {
  return vec_select(light.found, vec_add(radiance, vec_scale(light.weight, light.value)), radiance);
}

// Starts the next sample of the job in the lanes of `starting`.
static inline void start_paths(const Scene* scene, Subpath* path, Vec3* radiance, JobList list, Job job,
                               Mask starting) {
  Subpath first = *path;
  first.sequence.pixel = int_to_uint(job.pixel);
  first.sequence.sample = int_to_uint(sample_number(list, job));
  start_at_camera(scene, &first);
  path->ray = select_ray(starting, first.ray, path->ray);
  path->throughput = vec_select(starting, first.throughput, path->throughput);
  // A constant where nothing refracts.
  path->unattenuated = HAS_TRANSMISSION ? (starting ? (Real)(1.0f) : path->unattenuated) : (Real)(1.0f);
  path->edges = starting ? (Int)(0) : path->edges;
  path->delta = path->delta & !starting;
  path->sequence.pixel = starting ? first.sequence.pixel : path->sequence.pixel;
  path->sequence.sample = starting ? first.sequence.sample : path->sequence.sample;
  *radiance = vec_select(starting, vec_all((Real)(0.0f)), *radiance);
}

// The control variate of --ambient: for the constant incident radiance `ambient`, the exact reflected radiance minus
// the sampled one. Its mean is 0.
static inline Vec3 ambient_variate(Vertex v, MaterialSample sample, Vec3 throughput, float ambient) {
  const Vec3 sampled = vec_select(sample.survives, sample.weight, vec_all((Real)(0.0f)));
  const Vec3 difference = vec_sub(material_reflectivity(v.material, v.fixed), sampled);
  return vec_scale((Real)(ambient), vec_mul(throughput, difference));
}

__kernel void trace_paths(SCENE_PARAMETERS, LAUNCH_PARAMETERS, float ambient, __global float* sums) {
  SCENE_FROM_PARAMETERS
  LAUNCH_FROM_PARAMETERS
  Job job = first_job(list);
  Subpath path = no_subpath(seed, sets);
  Vec3 radiance = vec_all((Real)(0.0f));
  Uint rays = (Uint)(0u), shadow_rays = (Uint)(0u);
  Mask alive = NO_LANES;
  const int by_packets = HAS_CAMERA_PACKETS && block_samples >= LEAST_PACKET;
  CameraHits next_hits;

  for (Mask working = jobs_left(list, job); any_lane(working); working = jobs_left(list, job)) {
    const Mask starting = working & !alive;
    if (any_lane(starting)) start_paths(&scene, &path, &radiance, list, job, starting);

    Hit hit = trace_edge(&scene, &path, 0, by_packets ? working & !starting : working);
    if (by_packets) hit = camera_hits(&scene, path.sequence, list, job, &next_hits, hit, starting);
    const Arrival arrival = arrive(&scene, &path, hit, limits, working);
    rays += working ? (Uint)(1u) : (Uint)(0u);
    const Mask leaves_scene = working & !arrival.hits;
    if (HAS_SKY && any_lane(leaves_scene)) radiance = add_found(radiance, hit_sky(&scene, &path, leaves_scene));
    radiance = add_found(radiance, hit_light(&scene, &path, arrival.vertex.point, arrival.distance, arrival.hits));

    if (CONNECT != CONNECT_NONE) {
      LightSample light;
      const Mask reaches = draw_light(&scene, &path, arrival.vertex, &light, arrival.scattered);
      if (any_lane(reaches)) {
        const Mask lit = reaches & !shadow_ray_blocked(&scene, light.ray, light.distance, &light.radiance, reaches);
        if (any_lane(lit)) radiance = add_found(radiance, sampled_light(&scene, &path, arrival.vertex, light, lit));
        shadow_rays += reaches ? (Uint)(1u) : (Uint)(0u);
      }
    }
    MaterialSample sample;
    const Vec3 throughput = path.throughput;
    alive = scatter(&path, arrival.vertex, 0, DIMENSION_SCATTERING(path.edges), limits, &sample, arrival.scattered);
    if (HAS_AMBIENT) {
      const Vec3 variate = ambient_variate(arrival.vertex, sample, throughput, ambient);
      radiance = vec_select(arrival.scattered, vec_add(radiance, variate), radiance);
    }
    const Mask ended = working & !alive;
    if (any_lane(ended)) add_sample(list, &job, radiance, sums, ended);
  }
  const int item = (int)get_global_id(0) * 2;
  counters[item] = sum_of_lanes(rays);
  counters[item + 1] = sum_of_lanes(shadow_rays);
}
