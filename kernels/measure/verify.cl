// Kernels of `phlux verify`: the functions of lobes/material.cl for one material.
//
// Arrays have one plane per value: value k of all elements, then value k + 1 of all elements.
#include "measure/only_material.cl"

#define PLANE(k) ((size_t)(k)*get_global_size(0) + get_global_id(0))

#define VERIFY_PARAMETERS __global const float *materials, __global const float *table, int material
#define VERIFY_MATERIAL(fixed) only_material_from(materials + material * MATERIAL_WORDS, table, (fixed).z >= 0.0f)

static inline Vec3 vec_from_planes(__global const Real* from, int first) {
  return vec3(from[PLANE(first)], from[PLANE(first + 1)], from[PLANE(first + 2)]);
}

static inline void vec_to_planes(__global Real* to, int first, Vec3 v) {
  to[PLANE(first)] = v.x;
  to[PLANE(first + 1)] = v.y;
  to[PLANE(first + 2)] = v.z;
}

// Directions are given and returned with z along the normal of the front. Models that transmit have z on the side of
// `fixed`; others do not scatter below the surface.
static inline Vec3 seen_from(Vec3 fixed, Vec3 v) {
  return HAS_TRANSMISSION ? vec3(v.x, v.y, fixed.z < 0.0f ? -v.z : v.z) : v;
}

static inline MaterialSample sample_on_its_side(Material m, Vec3 fixed, RandomDraws random, int roulette) {
  MaterialSample s = material_sample(m, seen_from(fixed, fixed), random, vec_all((Real)(1.0f)),
                                     roulette ? ALL_LANES : NO_LANES, ALL_LANES);
  s.direction = seen_from(fixed, s.direction);
  return s;
}

// Ten planes: direction, weight, density, 1 where the path survives, draws, 1 for a delta event.
static inline void sample_to_planes(__global Real* to, MaterialSample s) {
  vec_to_planes(to, 0, s.direction);
  vec_to_planes(to, 3, s.weight);
  to[PLANE(6)] = s.density;
  to[PLANE(7)] = s.survives ? (Real)(1.0f) : (Real)(0.0f);
  to[PLANE(8)] = to_real(s.draws);
  to[PLANE(9)] = s.delta ? (Real)(1.0f) : (Real)(0.0f);
}

// Paths first, first + 1, ... of the random sequence of a render with this seed.
__kernel void sample_model(VERIFY_PARAMETERS, float fixed_x, float fixed_y, float fixed_z, uint2 seed, uint first,
                           int roulette, __global Real* samples) {
  RandomSequence sequence;
  sequence.pixel = first + (uint)get_global_id(0) * LANES + int_to_uint((Int)(LANE_NUMBERS));
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  const Vec3 fixed = vec3((Real)(fixed_x), (Real)(fixed_y), (Real)(fixed_z));
  sample_to_planes(samples,
                   sample_on_its_side(VERIFY_MATERIAL(fixed), fixed, random_draws(sequence, (Uint)(0u)), roulette));
}

// The same for given first random words, in four planes.
__kernel void drive_model(VERIFY_PARAMETERS, float fixed_x, float fixed_y, float fixed_z, __global const Uint* words,
                          int roulette, __global Real* samples) {
  RandomDraws random;
  random.sequence.pixel = (Uint)((uint)get_global_id(0));
  random.sequence.sample = int_to_uint((Int)(LANE_NUMBERS));
  random.sequence.seed = (uint2)(0u, 0u);
  random.dimension = (Uint)(0u);
  random.words.x = words[PLANE(0)];
  random.words.y = words[PLANE(1)];
  random.words.z = words[PLANE(2)];
  random.words.w = words[PLANE(3)];
  const Vec3 fixed = vec3((Real)(fixed_x), (Real)(fixed_y), (Real)(fixed_z));
  sample_to_planes(samples, sample_on_its_side(VERIFY_MATERIAL(fixed), fixed, random, roulette));
}

// For pairs of directions (a, b), six planes. Ten planes: f_r with a fixed, f_r with b fixed (times the squared
// relative index of refraction where they are on different sides, so that both are equal), the density of b for a fixed
// and of a for b fixed as two calls give them, then the reverse densities of the same two calls.
__kernel void evaluate_model(VERIFY_PARAMETERS, __global const Real* pairs, __global Real* values) {
  const Vec3 a = vec_from_planes(pairs, 0), b = vec_from_planes(pairs, 3);
  const Material m = VERIFY_MATERIAL(a);
  const LobeValue from_a = material_evaluate(m, seen_from(a, a), seen_from(a, b));
  const LobeValue from_b = material_evaluate(VERIFY_MATERIAL(b), seen_from(b, b), seen_from(b, a));
  vec_to_planes(values, 0, from_a.value);
  vec_to_planes(values, 3, vec_scale(1.0f / radiance_scale(m, seen_from(a, b)), from_b.value));
  values[PLANE(6)] = from_a.density;
  values[PLANE(7)] = from_b.density;
  values[PLANE(8)] = from_a.reverse;
  values[PLANE(9)] = from_b.reverse;
}

// Three planes of reflectivities, for three of directions.
__kernel void integrate_model(VERIFY_PARAMETERS, __global const Real* directions, __global Real* reflectivities) {
  const Vec3 fixed = vec_from_planes(directions, 0);
  vec_to_planes(reflectivities, 0, material_reflectivity(VERIFY_MATERIAL(fixed), seen_from(fixed, fixed)));
}
