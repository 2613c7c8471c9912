// Formulas that the kernels use, and alternatives: `phlux bench arithmetic` measures their errors and times. Each is a
// kernel with the same arguments (MEASURE below).
#include "math/directions.h"
#include "math/frames.h"
#include "math/vectors.h"

#define TWO_PI 6.2831853f
#define LN_2 0.693147181f

// ---- Powers by polynomials of our own, fitted for the least relative error

// log2(1 + t) for t in [sqrt(1/2) - 1, sqrt(2) - 1], to 3e-8.
static inline Real log2_near_one(Real t) {
  Real p = (Real)(1.25837013e-01f);
  p = fma(p, t, (Real)(-2.07269743e-01f));
  p = fma(p, t, (Real)(2.15715602e-01f));
  p = fma(p, t, (Real)(-2.38944829e-01f));
  p = fma(p, t, (Real)(2.87916243e-01f));
  p = fma(p, t, (Real)(-3.60703677e-01f));
  p = fma(p, t, (Real)(4.80910629e-01f));
  p = fma(p, t, (Real)(-7.21347332e-01f));
  p = fma(p, t, (Real)(1.44269502f));
  return t * p;
}

// x = 2^exponent (1 + t) with t as above, for positive normal x.
static inline Int exponent_of(Real x) { return (real_bits(x) - (Int)(0x3f3504f3)) >> 23; }
static inline Real mantissa_of(Real x, Int exponent) { return bits_real(real_bits(x) - (exponent << 23)); }

static inline Real own_log2(Real x) {
  const Int exponent = exponent_of(x);
  return to_real(exponent) + log2_near_one(mantissa_of(x, exponent) - 1.0f);
}

// log2(1 + t) for t > -1, accurate for small t.
static inline Real own_log2_1p(Real t) {
  const Real x = 1.0f + t;
  const Int exponent = exponent_of(x);
  return to_real(exponent) + log2_near_one(exponent == 0 ? t : mantissa_of(x, exponent) - 1.0f);
}

// 2^x for x <= 0, to 1e-7; 2^-126 below.
static inline Real own_exp2(Real x) {
  const Real in_range = larger(x, (Real)(-126.0f));
  const Real whole = rint(in_range), r = in_range - whole;
  Real p = (Real)(1.32764725e-03f);
  p = fma(p, r, (Real)(9.67554096e-03f));
  p = fma(p, r, (Real)(5.55071309e-02f));
  p = fma(p, r, (Real)(2.40221202e-01f));
  p = fma(p, r, (Real)(6.93146944e-01f));
  p = fma(p, r, (Real)(1.00000012f));
  return p * bits_real((to_int(whole) + 127) << 23);
}

// -expm1(x) for x <= 0, to 2e-7: by a polynomial where 1 - exp(x) would cancel.
static inline Real own_minus_expm1(Real x) {
  Real p = (Real)(1.12163485e-03f);
  p = fma(p, x, (Real)(8.18738621e-03f));
  p = fma(p, x, (Real)(4.16290909e-02f));
  p = fma(p, x, (Real)(1.66662246e-01f));
  p = fma(p, x, (Real)(4.99999821e-01f));
  p = fma(p, x, (Real)(1.0f));
  return x > -0.5f ? -x * p : 1.0f - exp(x);
}

// ---- Meanings of the inputs

static inline Vec3 vec_of(const Real* in) { return vec3(in[0], in[1], in[2]); }
static inline Real dot_of(const Real* in) { return vec_dot(vec_of(in), vec_of(in + 3)); }
static inline Real minus_versine_of(const Real* in) {
  const Vec3 chord = vec_sub(vec_of(in), vec_of(in + 3));
  return -0.5f * vec_dot(chord, chord);
}
static inline void put(Vec3 v, Real* out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}
static inline void put_frame(Vec3 x, Vec3 y, Real* out) {
  put(x, out);
  put(y, out + 3);
}

// ---- Frames

// The cross product with the axis of the smaller component (Hughes and Moeller 1999).
static inline void frame_by_cross(Vec3 z, Vec3* x, Vec3* y) {
  const Mask wide = fabs(z.x) > fabs(z.z);
  *x = vec_normalize(vec3(wide ? -z.y : (Real)(0.0f), wide ? z.x : -z.z, wide ? (Real)(0.0f) : z.y));
  *y = vec_cross(z, *x);
}

// The cross product with a fixed axis, or with another axis if z is nearly parallel to it.
static inline void frame_by_up(Vec3 z, Vec3* x, Vec3* y) {
  const Mask along = fabs(z.z) > 0.999f;
  *x = vec_normalize(vec_select(along, vec3((Real)(0.0f), -z.z, z.y), vec3(-z.y, z.x, (Real)(0.0f))));
  *y = vec_cross(z, *x);
}

// Frisvad 2012: no square root, but a singularity at z = -1.
static inline void frame_by_frisvad(Vec3 z, Vec3* x, Vec3* y) {
  const Real a = 1.0f / (1.0f + z.z), b = -z.x * z.y * a;
  const Mask singular = z.z < -0.9999999f;
  *x = vec_select(singular, vec3((Real)(0.0f), (Real)(-1.0f), (Real)(0.0f)), vec3(1.0f - z.x * z.x * a, b, -z.x));
  *y = vec_select(singular, vec3((Real)(-1.0f), (Real)(0.0f), (Real)(0.0f)), vec3(b, 1.0f - z.y * z.y * a, -z.y));
}

// ---- Offsets that prevent a ray from hitting the surface that it leaves: in[0..2] is the position, in[3..5] the
// normal

// Waechter and Binder 2019: a step of some units in the last place of each component, or a fixed one near 0.
static inline Real ulp_step(Real position, Real normal) {
  const Int units = to_int(256.0f * normal);
  const Real moved = bits_real(real_bits(position) + (position < 0.0f ? -units : units));
  return fabs(position) < 1.0f / 32.0f ? fma(normal, (Real)(1.0f / 65536.0f), position) : moved;
}

// ---- Kernels

// Reads `inputs` floats of each of `count` elements (value k of all elements, then value k + 1), and writes `outputs`
// floats likewise. For timing, with `repeats` above 1, the formula is evaluated again with `nothing` = 0 added to its
// inputs, and the results are summed: the compiler cannot remove this, and operands stay in registers. count is a
// multiple of LANES.
#define MEASURE(name, inputs, outputs, formula)                                                                        \
  __kernel void name(const __global float* values, int count, float exponent, int repeats, float nothing,              \
                     __global float* results) {                                                                        \
    const int step = (int)get_global_size(0) * LANES;                                                                  \
    for (int at = (int)get_global_id(0) * LANES; at < count; at += step) {                                             \
      Real given[inputs], sums[outputs];                                                                               \
      for (int k = 0; k < inputs; ++k) given[k] = load_reals(values + k * count + at);                                 \
      for (int k = 0; k < outputs; ++k) sums[k] = (Real)(0.0f);                                                        \
      for (int repeat = 0; repeat < repeats; ++repeat) {                                                               \
        const Real shift = (Real)(nothing * (float)repeat);                                                            \
        const Real n = exponent + shift;                                                                               \
        (void)n;                                                                                                       \
        Real in[inputs], out[outputs];                                                                                 \
        for (int k = 0; k < inputs; ++k) in[k] = given[k] + shift;                                                     \
        formula;                                                                                                       \
        for (int k = 0; k < outputs; ++k) sums[k] += out[k];                                                           \
      }                                                                                                                \
      for (int k = 0; k < outputs; ++k) scatter_real(results + k * count, at + LANE_NUMBERS, sums[k], ALL_LANES);      \
    }                                                                                                                  \
  }

// The loop without a formula, with the same numbers of inputs and outputs.
MEASURE(empty_1_1, 1, 1, out[0] = in[0] + n)
MEASURE(empty_1_2, 1, 2, out[0] = in[0] + n; out[1] = in[0])
MEASURE(empty_6_1, 6, 1, out[0] = (in[0] + in[1]) + (in[2] + in[3]) + (in[4] + in[5]) + n)
MEASURE(empty_3_6, 3, 6, put_frame(vec_of(in), vec_of(in), out))
MEASURE(empty_7_3, 7, 3, out[0] = in[0] + in[3]; out[1] = in[1] + in[4]; out[2] = (in[2] + in[5]) + in[6])

// cos^n of the angle between two directions.
MEASURE(lobe_pow, 6, 1, out[0] = pow(dot_of(in), n))
MEASURE(lobe_powr, 6, 1, out[0] = powr(dot_of(in), n))
MEASURE(lobe_own_pow, 6, 1, out[0] = own_exp2(n * own_log2(dot_of(in))))
MEASURE(lobe_exp_log, 6, 1, out[0] = exp(n * log(dot_of(in))))
MEASURE(lobe_exp_log1p, 6, 1, out[0] = exp(n * log1p(minus_versine_of(in))))
MEASURE(lobe_own_log1p, 6, 1, out[0] = exp(n * LN_2 * own_log2_1p(minus_versine_of(in))))
MEASURE(lobe_exp_versine, 6, 1, out[0] = exp(n * minus_versine_of(in)))

// sin(alpha) where cos(alpha) = u^(1 / (n + 1)).
MEASURE(sine_pow, 1, 1, out[0] = sqrt(1.0f - pow(in[0], 2.0f / (n + 1.0f))))
MEASURE(sine_product, 1, 1, const Real c = pow(in[0], 1.0f / (n + 1.0f)); out[0] = sqrt((1.0f - c) * (1.0f + c)))
MEASURE(sine_own_pow, 1, 1, out[0] = sqrt(1.0f - own_exp2(2.0f / (n + 1.0f) * own_log2(in[0]))))
MEASURE(sine_expm1, 1, 1, out[0] = sqrt(-expm1(2.0f * log(in[0]) / (n + 1.0f))))
MEASURE(sine_own, 1, 1, out[0] = sqrt(own_minus_expm1(2.0f * LN_2 * own_log2(in[0]) / (n + 1.0f))))
MEASURE(sine_log, 1, 1, out[0] = sqrt(-2.0f * log(in[0]) / (n + 1.0f)))

// A frame about a direction.
MEASURE(frame_duff, 3, 6, const Frame f = frame_about(vec_of(in)); put_frame(f.x, f.y, out))
MEASURE(frame_cross, 3, 6, Vec3 x; Vec3 y; frame_by_cross(vec_of(in), &x, &y); put_frame(x, y, out))
MEASURE(frame_up, 3, 6, Vec3 x; Vec3 y; frame_by_up(vec_of(in), &x, &y); put_frame(x, y, out))
MEASURE(frame_frisvad, 3, 6, Vec3 x; Vec3 y; frame_by_frisvad(vec_of(in), &x, &y); put_frame(x, y, out))

// Cosine and sine of 2 pi turns.
MEASURE(turns_own, 1, 2, cos_sin_turns(in[0], &out[0], &out[1]))
MEASURE(turns_sincos, 1, 2, out[1] = sincos(TWO_PI * in[0], &out[0]))
MEASURE(turns_cospi, 1, 2, out[0] = cospi(2.0f * in[0]); out[1] = sinpi(2.0f * in[0]))
MEASURE(turns_root, 1, 2, const Real c = cos(TWO_PI * in[0]); const Real s = sqrt(larger(1.0f - c * c, (Real)(0.0f)));
        out[0] = c; out[1] = in[0] > 0.5f ? -s : s)

// Functions.
MEASURE(function_exp, 1, 1, out[0] = exp(in[0]))
MEASURE(function_log, 1, 1, out[0] = log(in[0]))
MEASURE(function_log1p, 1, 1, out[0] = log1p(in[0]))
MEASURE(function_expm1, 1, 1, out[0] = expm1(in[0]))
MEASURE(function_own_expm1, 1, 1, out[0] = -own_minus_expm1(in[0]))
MEASURE(function_own_exp2, 1, 1, out[0] = own_exp2(1.44269504f * in[0]))
MEASURE(function_own_log, 1, 1, out[0] = LN_2 * own_log2(in[0]))
MEASURE(function_own_log1p, 1, 1, out[0] = LN_2 * own_log2_1p(in[0]))
MEASURE(function_sqrt, 1, 1, out[0] = sqrt(in[0]))
MEASURE(function_rsqrt, 1, 1, out[0] = rsqrt(in[0]))
MEASURE(function_one_over_sqrt, 1, 1, out[0] = 1.0f / sqrt(in[0]))
MEASURE(function_divide, 1, 1, out[0] = 1.0f / in[0])

// A position moved off its surface; in[6] is the largest coordinate in its computation.
MEASURE(offset_fixed, 7, 3, put(vec_along(vec_of(in), (Real)(1e-3f), vec_of(in + 3)), out))
MEASURE(offset_scaled, 7, 3,
        put(vec_along(vec_of(in), 9.5367432e-7f * (vec_largest(vec_of(in)) + in[6]), vec_of(in + 3)), out))
MEASURE(offset_ulps, 7, 3, put(vec3(ulp_step(in[0], in[3]), ulp_step(in[1], in[4]), ulp_step(in[2], in[5])), out))

// What libraries for compilers without a device lack.
#ifdef PHLUX_NATIVE
MEASURE(lobe_native_powr, 6, 1, out[0] = native_powr(dot_of(in), n))
MEASURE(lobe_native_exp_log, 6, 1, out[0] = native_exp(n * native_log(dot_of(in))))
MEASURE(sine_native, 1, 1, out[0] = native_sqrt(1.0f - native_powr(in[0], 2.0f / (n + 1.0f))))
MEASURE(turns_native, 1, 2, out[0] = native_cos(TWO_PI * in[0]); out[1] = native_sin(TWO_PI * in[0]))
MEASURE(function_native_exp, 1, 1, out[0] = native_exp(in[0]))
MEASURE(function_native_log, 1, 1, out[0] = native_log(in[0]))
MEASURE(function_native_sqrt, 1, 1, out[0] = native_sqrt(in[0]))
MEASURE(function_native_rsqrt, 1, 1, out[0] = native_rsqrt(in[0]))
MEASURE(function_native_divide, 1, 1, out[0] = native_recip(in[0]))
#endif
