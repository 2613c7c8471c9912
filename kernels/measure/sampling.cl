// Sampling of a reflectance model without a scene: one material, one angle of incidence, one kind of light.
#include "measure/only_material.cl"
#include "measure/sampling_radiance.h"

// One of FIXED_DIRECTIONS directions that differ only in their longitude, in each lane: three times LANES floats each.
// They are read for every sample, so that computations that depend on them stay in the loop, as in a render.
static inline Vec3 fixed_direction(const __global float* directions, int number) {
  const __global float* at = directions + (number & (FIXED_DIRECTIONS - 1)) * 3 * LANES;
  return vec3(load_reals(at), load_reals(at + LANES), load_reals(at + 2 * LANES));
}

// Values of SAMPLED_BY: the sampling of the model itself, or one of two densities that do not depend on the model.
#define SAMPLED_BY_MODEL 0
#define SAMPLED_BY_COSINE 1
#define SAMPLED_BY_HEMISPHERE 2

static inline MaterialSample sample_of(Material m, Vec3 fixed, RandomDraws random, Mask absorbing) {
  if (SAMPLED_BY == SAMPLED_BY_MODEL)
    return material_sample(m, fixed, random, vec_all((Real)(1.0f)), absorbing, ALL_LANES);
  const Real u1 = uniform_real(random.words.y), u2 = uniform_real(random.words.z);
  MaterialSample s;
  s.direction = SAMPLED_BY == SAMPLED_BY_COSINE ? cosine_direction(u1, u2) : hemisphere_direction(u1, u2);
  s.density = SAMPLED_BY == SAMPLED_BY_COSINE ? s.direction.z * INV_PI : (Real)(0.5f * INV_PI);
  s.weight = vec_scale(s.direction.z / s.density, material_evaluate(m, fixed, s.direction).value);
  s.survives = ALL_LANES;
  s.delta = NO_LANES;
  s.draws = (Int)(1);
  return s;
}

// values[i]: mean over the channels of f_r, for this fixed direction and the i-th of `count` others of three floats
// each.
__kernel void evaluate_directions(const __global float* materials, const __global float* lobe_tables, float4 fixed,
                                  const __global float* directions, int count, __global float* values) {
  const Int element = (int)get_global_id(0) * LANES + LANE_NUMBERS;
  const Mask inside = element < count;
  const Int at = inside ? 3 * element : (Int)(0);
  const Vec3 generated = gather_vec(directions, at);
  const Vec3 known = vec3((Real)(fixed.x), (Real)(fixed.y), (Real)(fixed.z));
  const LobeValue v = material_evaluate(only_material(materials, lobe_tables), known, generated);
  scatter_real(values, element, vec_mean(v.value), inside);
}

// Incident radiance from `direction`, which is above the surface.
static inline Real radiance_from(int kind, Vec3 fixed, Vec3 direction) {
  if (kind == RADIANCE_MIRROR_DISK) {
    const Real dx = direction.x + fixed.x, dy = direction.y + fixed.y, dz = direction.z - fixed.z;
    const Mask inside = fma(dx, dx, fma(dy, dy, dz * dz)) < MIRROR_DISK_CHORD2;
    return inside ? (Real)(MIRROR_DISK_RADIANCE) : (Real)(0.0f);
  }
  if (kind == RADIANCE_HORIZON_SKY) return HORIZON_SKY_SCALE / (direction.z + HORIZON_SKY_HEIGHT);
  return (Real)(1.0f);
}

// Sums of powers of d = weight x radiance - centre over the samples of one block in one lane. The weight is 0 for a
// path that does not survive or is below the surface; centre is near the mean, which reduces rounding errors.
typedef struct {
  Real d, d2, d3, d4;
} PowerSums;

static inline void add_powers(PowerSums* sums, Real d) {
  const Real d2 = d * d;
  sums->d += d;
  sums->d2 += d2;
  sums->d3 = fma(d2, d, sums->d3);
  sums->d4 = fma(d2, d2, sums->d4);
}

// sums: four floats for every block and lane, at [((item * blocks + block) * 4 + power - 1) * LANES + lane].
// counts, three for each work-item: reflected rays, directions that were drawn, and invalid samples: not a unit vector,
// no positive density, or a weight that is not finite.
__kernel void sample_moments(const __global float* materials, const __global float* lobe_tables,
                             const __global float* directions, uint2 seed, uint first_sample, int blocks,
                             int block_samples, int roulette, int light, float centre, __global float* sums,
                             __global uint* counts) {
  const Material m = only_material(materials, lobe_tables);
  const int item = (int)get_global_id(0);
  RandomSequence sequence;
  sequence.pixel = int_to_uint((Int)(item * LANES) + LANE_NUMBERS);
  sequence.seed = seed;
  const Mask absorbing = roulette != 0 ? (Mask)(ALL_LANES) : (Mask)(NO_LANES);
  Uint rays = (Uint)(0u), defects = (Uint)(0u);
  Int draws = (Int)(0);
  for (int block = 0; block < blocks; ++block) {
    PowerSums block_sums;
    block_sums.d = block_sums.d2 = block_sums.d3 = block_sums.d4 = (Real)(0.0f);
    for (int i = 0; i < block_samples; ++i) {
      sequence.sample = (Uint)(first_sample + (uint)(block * block_samples + i));
      const Vec3 fixed = fixed_direction(directions, i);
      const MaterialSample s = sample_of(m, fixed, random_draws(sequence, (Uint)(2u)), absorbing);
      const Mask goes_on = s.survives & (s.direction.z > 0.0f);
      const Real weight = vec_mean(s.weight);
      const Real value = weight * radiance_from(light, fixed, s.direction);
      const Real length2 = vec_dot(s.direction, s.direction);
      const Mask fine = (fabs(length2 - 1.0f) < 1e-5f) & (s.density > 0.0f) & (weight - weight == 0.0f);
      add_powers(&block_sums, (goes_on ? value : (Real)(0.0f)) - centre);
      rays += goes_on ? (Uint)(1u) : (Uint)(0u);
      defects += (goes_on & !fine) ? (Uint)(1u) : (Uint)(0u);
      draws += s.draws;
    }
    const int at = (item * blocks + block) * 4 * LANES;
    const Int lane = at + LANE_NUMBERS;
    scatter_real(sums, lane, block_sums.d, ALL_LANES);
    scatter_real(sums, lane + LANES, block_sums.d2, ALL_LANES);
    scatter_real(sums, lane + 2 * LANES, block_sums.d3, ALL_LANES);
    scatter_real(sums, lane + 3 * LANES, block_sums.d4, ALL_LANES);
  }
  counts[item * 3] = sum_of_lanes(rays);
  counts[item * 3 + 1] = sum_of_lanes(int_to_uint(draws));
  counts[item * 3 + 2] = sum_of_lanes(defects);
}
