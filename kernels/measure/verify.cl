// What `phlux verify` asks of the reflectance model: the four functions of phong.cl for one material, as they are.
//
// Arrays of lanes hold one plane per value: value k of all elements, then value k + 1 of all elements.
// PHLUX_GIVEN_WORDS lets the host choose a sampler's random numbers.
#include "measure/only_material.cl"

#define PLANE(k) ((size_t)(k)*get_global_size(0) + get_global_id(0))

#define VERIFY_PARAMETERS __global const MaterialRecord *materials, __global const float *table, int material
#define VERIFY_MATERIAL only_material(materials + material, table)

static inline Vec3 vec_from_planes(__global const Real* from, int first) {
  return vec3(from[PLANE(first)], from[PLANE(first + 1)], from[PLANE(first + 2)]);
}

static inline void vec_to_planes(__global Real* to, int first, Vec3 v) {
  to[PLANE(first)] = v.x;
  to[PLANE(first + 1)] = v.y;
  to[PLANE(first + 2)] = v.z;
}

// Nine planes: direction, weight, density, 1 where the path survives, draws.
static inline void sample_to_planes(__global Real* to, PhongSample s) {
  vec_to_planes(to, 0, s.direction);
  vec_to_planes(to, 3, s.weight);
  to[PLANE(6)] = s.density;
  to[PLANE(7)] = s.survives ? (Real)(1.0f) : (Real)(0.0f);
  to[PLANE(8)] = to_real(s.draws);
}

// Paths first, first + 1, ... of the sequence that a render with this seed would use.
__kernel void sample_model(VERIFY_PARAMETERS, float fixed_x, float fixed_y, float fixed_z, uint2 seed, uint first,
                           int roulette, __global Real* samples) {
  RandomSequence sequence;
  sequence.pixel = first + (uint)get_global_id(0) * LANES + int_to_uint((Int)(LANE_NUMBERS));
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  RandomWords counter;
  counter.x = sequence.pixel;
  counter.y = counter.z = counter.w = (Uint)(0u);
  sequence.given = philox(counter, seed);
  const Vec3 fixed = vec3((Real)(fixed_x), (Real)(fixed_y), (Real)(fixed_z));
  sample_to_planes(
      samples, phong_sample(VERIFY_MATERIAL, fixed, sequence, (Uint)(0u), roulette ? ALL_LANES : NO_LANES, ALL_LANES));
}

// The same for chosen words, four planes of them: what phong_sample takes for its first random words.
__kernel void drive_model(VERIFY_PARAMETERS, float fixed_x, float fixed_y, float fixed_z, __global const Uint* words,
                          int roulette, __global Real* samples) {
  RandomSequence sequence;
  sequence.pixel = (Uint)((uint)get_global_id(0));
  sequence.sample = int_to_uint((Int)(LANE_NUMBERS));
  sequence.seed = (uint2)(0u, 0u);
  sequence.given.x = words[PLANE(0)];
  sequence.given.y = words[PLANE(1)];
  sequence.given.z = words[PLANE(2)];
  sequence.given.w = words[PLANE(3)];
  const Vec3 fixed = vec3((Real)(fixed_x), (Real)(fixed_y), (Real)(fixed_z));
  sample_to_planes(
      samples, phong_sample(VERIFY_MATERIAL, fixed, sequence, (Uint)(0u), roulette ? ALL_LANES : NO_LANES, ALL_LANES));
}

// For pairs of directions, six planes. Eight planes: f_r, f_r with the directions' roles exchanged, and the density of
// either direction when the other is fixed: of the second, then of the first.
__kernel void evaluate_model(VERIFY_PARAMETERS, __global const Real* pairs, __global Real* values) {
  const Phong m = VERIFY_MATERIAL;
  const Vec3 a = vec_from_planes(pairs, 0), b = vec_from_planes(pairs, 3);
  vec_to_planes(values, 0, phong_eval(m, a, b));
  vec_to_planes(values, 3, phong_eval(m, b, a));
  values[PLANE(6)] = phong_density(m, a, b);
  values[PLANE(7)] = phong_density(m, b, a);
}

// Three planes of reflectivities, for cosines.
__kernel void integrate_model(VERIFY_PARAMETERS, __global const Real* cosines, __global Real* reflectivities) {
  vec_to_planes(reflectivities, 0, phong_reflectivity(VERIFY_MATERIAL, cosines[PLANE(0)]));
}
