// Light tracing (Dutre, Lafortune and Willems 1993): from the lights, reflecting at every surface; the eye is connected
// to every vertex, and to the light's own point where it can be seen.
#include "transport/light_walk.cl"

__kernel void trace_light(SCENE_PARAMETERS, int pixel_count, int first_pixel, int job_count, int first_sample,
                          int block_samples, uint2 seed, int max_edges, int roulette_edges, __global uint* counters,
                          int batch_jobs, int record_words, int record_capacity, __global float* records,
                          __global int* record_counts) {
  SCENE_FROM_PARAMETERS
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples};
  const WalkLimits limits = {max_edges, roulette_edges};
  uint rays = 0;
  ShadowQueue queue;
  queue.count = 0;
  queue.traced = 0;
  for (int index = (int)get_global_id(0); index < batch_count(list, batch_jobs); index += (int)get_global_size(0)) {
    Batch batch = batch_at(list, batch_jobs, index);
    Output output;
    output.records = records + (size_t)index * (size_t)record_words * (size_t)record_capacity;
    output.capacity = record_capacity;
    output.count = 0;

    Walk walk = no_walk(seed), next = no_walk(seed);
    Starts starts = no_starts();
    Mask alive = NO_LANES, started;
    while (true) {
      const Mask idle = !alive;
      while (wants_starts(&starts, &batch, count_lanes(idle)))
        put_starts(&starts, &next, leave_light(&scene, list, &batch, limits, &next, &queue, &output, &started));
      alive |= take_starts(&starts, &walk, idle);
      if (!any_lane(alive)) break;

      const Hit hit = scene_intersect(&scene, walk.ray, alive);
      rays += (uint)count_lanes(alive);
      walk.edges += alive ? (Int)(1) : (Int)(0);
      const SurfacePoint point = surface_point(&scene, walk.ray, hit);
      const Vertex vertex = vertex_at(&scene, walk.ray, point);
      const Mask reflecting = alive & (hit.primitive >= 0) & (walk.edges < max_edges) & can_reflect(&scene, vertex);
      show_vertex(&scene, &walk, vertex, &queue, &output, reflecting);
      alive = walk_on(&walk, vertex, 1, DIMENSION_LIGHT_PATH(walk.edges), walk.edges >= roulette_edges,
                      reflecting & (walk.edges + 1 < max_edges));
    }
    trace_last(&scene, &queue, &output);
    record_counts[index] = output.count;
  }
  __global uint* mine = counters + get_global_id(0) * 2;
  mine[0] = rays;
  mine[1] = queue.traced;
}
