// Samples the modified Phong model for parameters that are arguments of the kernel. The mean weight of a sample is the
// reflectivity, rho_d + rho_s (example.py, tests/phong).
#include "phong/load.h"

// Each work-item has LANES lanes (the macro WIDTH of the program). Each lane draws `samples` samples for a direction at
// this cosine to the normal, and writes their mean weight to its element of means, which has LANES elements for every
// work-item. table: the row for this exponent.
__kernel void mean_weight(float kd, float ks, float exponent, const __global float* table, float cosine, uint2 seed,
                          int samples, __global float* means) {
  const Phong model = phong_from(vec_all((Real)(kd)), vec_all((Real)(ks)), (Real)(exponent), table, (Int)(0));
  const Vec3 fixed = vec3((Real)(sqrt((1.0f - cosine) * (1.0f + cosine))), (Real)(0.0f), (Real)(cosine));
  const Int lane = (int)get_global_id(0) * LANES + LANE_NUMBERS;
  RandomSequence sequence;
  sequence.pixel = int_to_uint(lane);
  sequence.seed = seed;
  Real sum = (Real)(0.0f);
  for (int i = 0; i < samples; ++i) {
    sequence.sample = (Uint)((uint)i);
    const RandomDraws random = random_draws(sequence, (Uint)(0u));
    const Real choice = uniform_real(random.words.x); // chooses between the diffuse part and the lobe
    const LobeSample s = phong_sample(model, fixed, choice, random, ALL_LANES);
    sum += s.direction.z > 0.0f ? s.weight.x : (Real)(0.0f);
  }
  scatter_real(means, lane, sum / (float)samples, ALL_LANES);
}
