// Data of the figures of CW 197, from the functions of the path tracer: lane i computes element i. Arrays of vectors
// have three floats per vector.
#include "math/directions.h"
#include "measure/only_material.cl"

// The parameters of the hemisphere of CW 197, section 4.
#define SPACE_THETA_PHI 0
#define SPACE_C_PHI 1
#define SPACE_XI 2
#define SPACE_X_Y 3

static inline Int elements_of_item(void) { return (Int)((int)get_global_id(0) * LANES) + LANE_NUMBERS; }

static inline Vec3 gather_vec3_at(const __global float* vectors, Int index) {
  const Int at = 3 * index;
  return vec3(gather_real(vectors, at), gather_real(vectors, at + 1), gather_real(vectors, at + 2));
}

static inline Vec3 all_lanes_of(float4 v) { return vec3((Real)(v.x), (Real)(v.y), (Real)(v.z)); }

// Here the horizon is part of the hemisphere; the model is 0 there.
static inline Vec3 on_hemisphere(Vec3 v) { return vec3(v.x, v.y, larger(v.z, (Real)(1e-6f))); }

// values[i] = f_r for the i-th pair of directions.
__kernel void evaluate_pairs(const __global float* materials, const __global float* lobe_tables,
                             const __global float* fixed, const __global float* generated, int count,
                             __global float* values) {
  const Int element = elements_of_item();
  const Mask inside = element < count;
  const Int index = inside ? element : (Int)(0);
  const Material m = only_material(materials, lobe_tables);
  const Vec3 to = on_hemisphere(gather_vec3_at(generated, index));
  scatter_real(values, element, material_evaluate(m, gather_vec3_at(fixed, index), to).value.x, inside);
}

static inline Vec3 direction_of(int space, Real first, Real second) {
  switch (space) {
  case SPACE_THETA_PHI:
    return theta_phi_direction(first, second);
  case SPACE_C_PHI:
    return hemisphere_direction(1.0f - first, second);
  case SPACE_XI:
    return cosine_direction(1.0f - first, second);
  default:
    return vec3(first, second, sqrt(larger(1.0f - fma(first, first, second * second), (Real)(0.0f))));
  }
}

// d(omega) cos(theta) per unit of the parameters in the units of CW 197: theta and phi in radians, others without unit.
static inline Real measure_of(int space, Vec3 v) {
  switch (space) {
  case SPACE_THETA_PHI:
    return v.z * sqrt(fma(v.x, v.x, v.y * v.y));
  case SPACE_C_PHI:
    return v.z;
  case SPACE_XI:
    return (Real)(PI);
  default:
    return (Real)(1.0f);
  }
}

// The integrand of the reflectivity over a grid of a parameter space, first parameter slowest. `parameters` has two
// floats per element, in [0, 1] (x, y: in the unit disk); `values` gets five: the direction, f_r and the integrand.
__kernel void evaluate_parameters(const __global float* materials, const __global float* lobe_tables, float4 fixed,
                                  int space, const __global float* parameters, int count, __global float* values) {
  const Int element = elements_of_item();
  const Mask inside = element < count;
  const Int index = inside ? element : (Int)(0);
  const Material m = only_material(materials, lobe_tables);
  const Vec3 v =
      on_hemisphere(direction_of(space, gather_real(parameters, 2 * index), gather_real(parameters, 2 * index + 1)));
  const Real value = material_evaluate(m, all_lanes_of(fixed), v).value.x;
  scatter_vec(values, 5 * element, v, inside);
  scatter_real(values, 5 * element + 3, value, inside);
  scatter_real(values, 5 * element + 4, value * measure_of(space, v), inside);
}

// values: x, y and the weight of the i-th sample, which is 0 if it was absorbed or is below the surface.
__kernel void sample_squares(const __global float* materials, const __global float* lobe_tables, float4 fixed,
                             uint2 seed, int count, __global float* values) {
  const Int element = elements_of_item();
  const Mask inside = element < count;
  const Material m = only_material(materials, lobe_tables);
  RandomSequence sequence;
  sequence.pixel = int_to_uint(element);
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  const MaterialSample s = material_sample(m, all_lanes_of(fixed), random_draws(sequence, (Uint)(2u)),
                                           vec_all((Real)(1.0f)), ALL_LANES, inside);
  const Mask goes_on = s.survives & (s.direction.z > 0.0f);
  scatter_real(values, 3 * element, s.direction.x, inside);
  scatter_real(values, 3 * element + 1, s.direction.y, inside);
  scatter_real(values, 3 * element + 2, goes_on ? s.weight.x : (Real)(0.0f), inside);
}

// values[i]: the partial reflectivity through square i of side x side squares over [-1, 1]^2 in (x, y), rows of equal y
// first, estimated from `samples` points that are uniform in the square (CW 197, section 5).
__kernel void evaluate_squares(const __global float* materials, const __global float* lobe_tables, float4 fixed,
                               uint2 seed, int side, int samples, __global float* values) {
  const Int element = elements_of_item();
  const Mask inside = element < side * side;
  const Int row = element / side, column = element - row * side;
  const float width = 2.0f / (float)side;
  const Material m = only_material(materials, lobe_tables);
  RandomSequence sequence;
  sequence.pixel = int_to_uint(element);
  sequence.seed = seed;
  Real sum = (Real)(0.0f);
  for (int i = 0; i < samples; ++i) {
    sequence.sample = (Uint)((uint)i);
    const RandomWords words = random_words(sequence, (Uint)(0u), 0);
    const Real x = fma(width, to_real(column) + uniform_real(words.x), (Real)(-1.0f));
    const Real y = fma(width, to_real(row) + uniform_real(words.y), (Real)(-1.0f));
    const Real z2 = 1.0f - fma(x, x, y * y);
    const Mask on_disk = z2 > 0.0f;
    const Vec3 v = vec3(x, y, sqrt(on_disk ? z2 : (Real)(1.0f)));
    sum += on_disk ? material_evaluate(m, all_lanes_of(fixed), v).value.x : (Real)(0.0f);
  }
  scatter_real(values, element, sum * (width * width / (float)samples), inside);
}
