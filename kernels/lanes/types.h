// The types of one lane and of all lanes of a work-item, and conversions between them (see lanes.h).
#ifndef PHLUX_LANES_TYPES_H
#define PHLUX_LANES_TYPES_H

#include "lanes/inlined.h"

// The type of one lane of a Real, constants of that precision, and properties of it.
#ifdef PHLUX_DOUBLE
#if WIDTH != 1
#error "PHLUX_DOUBLE needs WIDTH 1"
#endif
typedef double Scalar;
#define REAL(literal) literal
#define REAL_HALF_ULP 1.1102230246251565e-16 // of 1: 2^-53
#define REAL_MAX DBL_MAX
#else
typedef float Scalar;
#define REAL(literal) literal##f
#define REAL_HALF_ULP 5.9604645e-8f // 2^-24
#define REAL_MAX FLT_MAX
#endif

#if WIDTH == 1
typedef Scalar Real;
typedef int Int;
typedef uint Uint;
typedef int Mask;
#define LANE_NUMBERS 0
#define ALL_LANES 1
#define LANE_CONVERT(type) convert_##type
#define LANE_AS(type) as_##type
#elif WIDTH == 4 || WIDTH == 8 || WIDTH == 16
#define LANE_JOIN_(a, b) a##b
#define LANE_JOIN(a, b) LANE_JOIN_(a, b)
typedef LANE_JOIN(float, WIDTH) Real;
typedef LANE_JOIN(int, WIDTH) Int;
typedef LANE_JOIN(uint, WIDTH) Uint;
typedef LANE_JOIN(int, WIDTH) Mask;
#define ALL_LANES ((Mask)(-1))
#define LANE_CONVERT(type) LANE_JOIN(convert_##type, WIDTH)
#define LANE_AS(type) LANE_JOIN(as_##type, WIDTH)
#if WIDTH == 4
#define LANE_NUMBERS ((Int)(0, 1, 2, 3))
#elif WIDTH == 8
#define LANE_NUMBERS ((Int)(0, 1, 2, 3, 4, 5, 6, 7))
#else
#define LANE_NUMBERS ((Int)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#endif
#else
#error "WIDTH must be 1, 4, 8 or 16"
#endif

#define LANES WIDTH
#define NO_LANES ((Mask)(0))

static inline Int to_int(Real x) { return LANE_CONVERT(int)(x); }
static inline Int uint_to_int(Uint x) { return LANE_AS(int)(x); }
static inline Uint int_to_uint(Int x) { return LANE_AS(uint)(x); }
#if WIDTH == 1
static inline Real to_real(Int x) { return (Real)x; }
static inline Real uint_to_real(Uint x) { return (Real)x; }
#else
static inline Real to_real(Int x) { return LANE_CONVERT(float)(x); }
static inline Real uint_to_real(Uint x) { return LANE_CONVERT(float)(x); }
#endif

// The bits of an Int as a Real, and back.
#ifdef PHLUX_DOUBLE
static inline Real carry_int(Int x) { return to_real(x); }
static inline Int carried_int(Real x) { return to_int(x); }
#else
static inline Int real_bits(Real x) { return LANE_AS(int)(x); }
static inline Real bits_real(Int x) { return LANE_AS(float)(x); }
static inline Real carry_int(Int x) { return bits_real(x); }
static inline Int carried_int(Real x) { return real_bits(x); }
#endif

// fmax and fmin without their treatment of NaN, which takes two more instructions.
static inline Real larger(Real a, Real b) { return a > b ? a : b; }
static inline Real smaller(Real a, Real b) { return a < b ? a : b; }
// floor(a / b) for a >= 0, b > 0, a + b < 2^31 and quotients below 2^22. The quotient of floats has an error below 1:
// at most 2.5 ulp of the division (OpenCL 1.2, 7.4), which are 5/8 at 2^22, and 1/4 there for the rounding of a to
// float; for b above 2^24, which is rounded too, quotients are below 2^7. It is thus off by one at most, and corrected.
static inline Int quotient(Int a, int b) {
  const Int q = to_int(to_real(a) / (float)b);
  const Int rest = a - q * b;
  return rest < 0 ? q - 1 : (rest >= b ? q + 1 : q);
}
// a / b; 0 where b is not above 0.
static inline Real ratio_or_zero(Real a, Real b) { return b > 0.0f ? a / b : (Real)(0.0f); }

// x multiplied by the sign of `sign`, by two bit operations.
static inline Real times_sign(Real x, Real sign) {
#ifdef PHLUX_DOUBLE
  return as_double(as_ulong(x) ^ (as_ulong(sign) & 0x8000000000000000UL));
#else
  return bits_real(real_bits(x) ^ (real_bits(sign) & (Int)(int)0x80000000u));
#endif
}

// Both halves of the 64-bit product of each lane with a constant. Compilers implement mul_hi by 16-bit products; the
// products of the even and of the odd lanes are one instruction each.
static inline void multiply_wide(Uint a, uint factor, Uint* high, Uint* low) {
#if WIDTH == 1 || !defined(__ENDIAN_LITTLE__)
  *high = mul_hi(a, (Uint)(factor));
  *low = a * factor;
#else
#if WIDTH == 4
#define LANE_PAIRS(x) as_ulong2(x)
#elif WIDTH == 8
#define LANE_PAIRS(x) as_ulong4(x)
#else
#define LANE_PAIRS(x) as_ulong8(x)
#endif
  const ulong low_half = 0xffffffffUL;
  *high = LANE_AS(uint)((((LANE_PAIRS(a) & low_half) * factor) >> 32) | (((LANE_PAIRS(a) >> 32) * factor) & ~low_half));
  *low = LANE_AS(uint)((((LANE_PAIRS(a) & low_half) * factor) & low_half) | (((LANE_PAIRS(a) >> 32) * factor) << 32));
#endif
}

#endif
