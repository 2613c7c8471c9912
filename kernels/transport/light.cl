// Light tracing (Dutre, Lafortune and Willems 1993): paths from the lights, scattered at every surface, whose vertices
// are connected to the camera.
#include "transport/light_subpath.cl"

__kernel void trace_light(SCENE_PARAMETERS, int pixel_count, int first_pixel, int job_count, int first_sample,
                          int block_samples, uint2 seed, uint2 point_sets, int max_edges, int roulette_edges,
                          __global uint* counters, int batch_jobs, int record_words, int record_capacity,
                          __global float* records, __global int* record_counts) {
  SCENE_FROM_PARAMETERS
  WorkItem work;
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples};
  const PathLimits limits = {max_edges, roulette_edges};
  const PointSets sets = {point_sets.x, point_sets.y};
  work.scene = &scene;
  work.list = list;
  work.limits = limits;
  work.seed = seed;
  work.sets = sets;
  work.rays = 0;
  empty_shadow_queue(&work.queue);
  for (int index = (int)get_global_id(0); index < batch_count(list, batch_jobs); index += (int)get_global_size(0)) {
    output_to(&work.output, records, index, record_words, record_capacity);
    trace_light_subpaths(&work, batch_at(list, batch_jobs, index));
    trace_last_shadow_rays(&scene, &work.queue, &work.output);
    record_counts[index] = work.output.count;
  }
  __global uint* mine = counters + get_global_id(0) * 2;
  mine[0] = work.rays;
  mine[1] = work.queue.traced;
}
