#include "scene/environment.cl"

__kernel void sample_map(SCENE_PARAMETERS, uint2 seed, __global const Uint* path, __global Vec3* direction) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  RandomSequence sequence;
  sequence.pixel = path[i];
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  direction[i] = sample_environment(&scene, random_words(sequence, (Uint)(0u), 0));
}

__kernel void look_at_map(SCENE_PARAMETERS, __global const Vec3* direction, __global Vec3* radiance,
                          __global Real* density) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const Environment e = environment_towards(&scene, direction[i]);
  radiance[i] = e.radiance;
  density[i] = e.density;
}
