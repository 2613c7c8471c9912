// Light tracing (Dutre, Lafortune and Willems 1993): paths from the lights, scattered at every surface, whose vertices
// are connected to the camera.
#include "transport/light_subpath.cl"

__kernel void trace_light(SCENE_PARAMETERS, LAUNCH_PARAMETERS, int batch_jobs, int record_words, int record_capacity,
                          __global float* records, __global int* record_counts) {
  SCENE_FROM_PARAMETERS
  LAUNCH_FROM_PARAMETERS
  WorkItem work;
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
