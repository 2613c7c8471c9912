// Lanes: the arithmetic types in which every other kernel file is written. WIDTH paths travel together in one
// work-item: 4, 8 or 16 on a CPU, whose vector registers they fill, and 1 on a GPU, where each type is a plain scalar.
// This is the only file that knows WIDTH.
//
// Operators and the built-in functions of OpenCL C work on Real, Int and Uint as they are. A comparison gives a Mask;
// masks combine with & | ! and select with ?: (for a Real, an Int or a Uint) or vec_select (for vectors.h's Vec3).
// A lane whose mask is off may hold anything, NaN included: select results, never multiply them by 0.
//
// PHLUX_DOUBLE makes Real a double, at WIDTH 1 alone: comparisons of double vectors give masks of long, which no Int
// goes with. Only this file knows of it. Shapes' tables are of doubles then. Camera, materials and lights stay floats,
// the same in either precision, and so do sums and splats on their way to the host: each is rounded once, to 2^-24.
#ifndef PHLUX_LANES_H
#define PHLUX_LANES_H

// One lane of a Real, a constant of that precision, and what follows from it.
#ifdef PHLUX_DOUBLE
#if WIDTH != 1
#error "PHLUX_DOUBLE needs WIDTH 1"
#endif
typedef double Scalar;
#define REAL(literal) literal
#define REAL_HALF_ULP 1.1102230246251565e-16 // of 1: 2^-53
#define REAL_LARGE 1e200                     // with room for products with ordinary numbers
#else
typedef float Scalar;
#define REAL(literal) literal##f
#define REAL_HALF_ULP 5.9604645e-8f // 2^-24
#define REAL_LARGE 1e30f
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

// AVX-512 has single instructions for what the portable forms below spell out; LANES_PORTABLE selects those forms.
// clang before 8 declares the indices of gathersiv16sf as floats.
#if WIDTH == 16 && defined(__AVX512F__) && !defined(LANES_PORTABLE) && defined(__has_builtin) && __clang_major__ >= 8
#if __has_builtin(__builtin_ia32_gathersiv16sf) && __has_builtin(__builtin_ia32_gathersiv16si) &&                      \
    __has_builtin(__builtin_ia32_cmpd512_mask) && __has_builtin(__builtin_ia32_compresssf512_mask) &&                  \
    __has_builtin(__builtin_ia32_expandsf512_mask) && __has_builtin(__builtin_ia32_expandsi512_mask) &&                \
    __has_builtin(__builtin_ia32_permvarsf512)
#define LANES_AVX512
typedef float LaneNativeFloats __attribute__((vector_size(64)));
typedef int LaneNativeInts __attribute__((vector_size(64)));
#define LANE_NATIVE_FLOATS(x) __builtin_astype((x), LaneNativeFloats)
#define LANE_NATIVE_INTS(x) __builtin_astype((x), LaneNativeInts)
#define LANE_REALS(x) __builtin_astype((x), Real)
#define LANE_INTS(x) __builtin_astype((x), Int)
#endif
#endif

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

// An Int that travels as a Real, and is the same when it is taken out again.
#ifdef PHLUX_DOUBLE
static inline Real carry_int(Int x) { return to_real(x); }
static inline Int carried_int(Real x) { return to_int(x); }
#else
static inline Int real_bits(Real x) { return LANE_AS(int)(x); }
static inline Real bits_real(Int x) { return LANE_AS(float)(x); }
static inline Real carry_int(Int x) { return bits_real(x); }
static inline Int carried_int(Real x) { return real_bits(x); }
#endif

// As fmax and fmin but for NaN, which costs them two more instructions.
static inline Real larger(Real a, Real b) { return a > b ? a : b; }
static inline Real smaller(Real a, Real b) { return a < b ? a : b; }

// x with the sign of `sign` multiplied in: two bit operations.
static inline Real times_sign(Real x, Real sign) {
#ifdef PHLUX_DOUBLE
  return as_double(as_ulong(x) ^ (as_ulong(sign) & 0x8000000000000000UL));
#else
  return bits_real(real_bits(x) ^ (real_bits(sign) & (Int)(int)0x80000000u));
#endif
}

// Both halves of the 64-bit product of each lane with a constant. Compilers make mul_hi from 16-bit pieces; the two
// products of even and odd lanes are one instruction each.
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

// ---- Questions about a mask

#ifdef LANES_AVX512
static inline uint lane_bits(Mask m) {
  return (ushort)__builtin_ia32_cmpd512_mask(LANE_NATIVE_INTS(m), LANE_NATIVE_INTS((Int)(0)), 4, (ushort)0xffff);
}
static inline int any_lane(Mask m) { return lane_bits(m) != 0; }
static inline int all_lanes(Mask m) { return lane_bits(m) == 0xffff; }
#elif WIDTH == 1
static inline int any_lane(Mask m) { return m != 0; }
static inline int all_lanes(Mask m) { return m != 0; }
#else
static inline int any_lane(Mask m) { return any(m); }
static inline int all_lanes(Mask m) { return all(m); }
#endif

// ---- Between lanes and memory

#if WIDTH == 4
#define LANE_EACH(per_lane) per_lane(0), per_lane(1), per_lane(2), per_lane(3)
#elif WIDTH == 8
#define LANE_EACH(per_lane)                                                                                            \
  per_lane(0), per_lane(1), per_lane(2), per_lane(3), per_lane(4), per_lane(5), per_lane(6), per_lane(7)
#elif WIDTH == 16
#define LANE_EACH(per_lane)                                                                                            \
  per_lane(0), per_lane(1), per_lane(2), per_lane(3), per_lane(4), per_lane(5), per_lane(6), per_lane(7), per_lane(8), \
      per_lane(9), per_lane(a), per_lane(b), per_lane(c), per_lane(d), per_lane(e), per_lane(f)
#endif

// base[index] in every lane; index counts 4-byte words and must be valid in every lane, whatever its mask.
static inline Real gather_real(const __global float* base, Int index) {
#ifdef LANES_AVX512
  return LANE_REALS(__builtin_ia32_gathersiv16sf(LANE_NATIVE_FLOATS((Real)(0.0f)), (const void*)(size_t)base,
                                                 LANE_NATIVE_INTS(index), (ushort)0xffff, 4));
#elif WIDTH == 1
  return base[index];
#else
#define LANE_LOAD(k) base[index.s##k]
  return (Real)(LANE_EACH(LANE_LOAD));
#endif
}

static inline Int gather_int(const __global int* base, Int index) {
#ifdef LANES_AVX512
  return LANE_INTS(__builtin_ia32_gathersiv16si(LANE_NATIVE_INTS((Int)(0)), (const void*)(size_t)base,
                                                LANE_NATIVE_INTS(index), (ushort)0xffff, 4));
#elif WIDTH == 1
  return base[index];
#else
  return (Int)(LANE_EACH(LANE_LOAD));
#endif
}

// table[index].member in every lane, for a __global array of structs of 4-byte members. The member's place is taken
// from the table's start, so that no array member is indexed beyond its end.
#define MEMBER_PLACE(type, table, member) (int)((const __global type*)&(table)->member - (const __global type*)(table))
#define GATHER_REAL(table, index, member)                                                                              \
  gather_real((const __global float*)(table),                                                                          \
              (index) * (int)(sizeof(*(table)) / 4) + MEMBER_PLACE(float, table, member))
#define GATHER_INT(table, index, member)                                                                               \
  gather_int((const __global int*)(table), (index) * (int)(sizeof(*(table)) / 4) + MEMBER_PLACE(int, table, member))

// A table of at most LANES structs of 4-byte members can be kept member by member, in private memory, where looking an
// entry up is to permute a register; a gather takes many times as long. Only where registers can be permuted.
#ifdef LANES_AVX512
#define LANES_PERMUTE
static inline Real permute_real(const float* values, Int index) {
  return LANE_REALS(__builtin_ia32_permvarsf512(LANE_NATIVE_FLOATS(vload16(0, values)), LANE_NATIVE_INTS(index)));
}
static inline Int permute_int(const float* values, Int index) { return carried_int(permute_real(values, index)); }
// The table has LANES entries of `words` words, used or not.
static inline void load_members(const __global void* table, int words, float (*members)[LANES]) {
  for (int word = 0; word < words; ++word)
    vstore16(gather_real((const __global float*)table, LANE_NUMBERS * words + word), 0, members[word]);
}
#define PERMUTE_REAL(members, table, index, member) permute_real((members)[MEMBER_PLACE(float, table, member)], index)
#define PERMUTE_INT(members, table, index, member) permute_int((members)[MEMBER_PLACE(int, table, member)], index)
#endif

// base[index] = value in the lanes of m, in lane order.
static inline void scatter_real(__global float* base, Int index, Real value, Mask m) {
#if WIDTH == 1
  if (m) base[index] = (float)value;
#else
#define LANE_STORE(k) (m.s##k ? (void)(base[index.s##k] = value.s##k) : (void)0)
  LANE_EACH(LANE_STORE);
#endif
}

static inline void scatter_int(__global int* base, Int index, Int value, Mask m) {
#if WIDTH == 1
  if (m) base[index] = value;
#else
  LANE_EACH(LANE_STORE);
#endif
}

// Private copies, for loops over lanes.
static inline void lanes_to_array(Real v, Scalar* array) {
#if WIDTH == 1
  *array = v;
#else
  LANE_JOIN(vstore, WIDTH)(v, 0, array);
#endif
}
static inline void int_lanes_to_array(Int v, int* array) {
#if WIDTH == 1
  *array = v;
#else
  LANE_JOIN(vstore, WIDTH)(v, 0, array);
#endif
}
static inline Real lanes_from_array(const Scalar* array) {
#if WIDTH == 1
  return *array;
#else
  return LANE_JOIN(vload, WIDTH)(0, array);
#endif
}
static inline Int int_lanes_from_array(const int* array) {
#if WIDTH == 1
  return *array;
#else
  return LANE_JOIN(vload, WIDTH)(0, array);
#endif
}

// WIDTH consecutive words from `base`.
static inline Real load_reals(const __global float* base) {
#if WIDTH == 1
  return *base;
#else
  return LANE_JOIN(vload, WIDTH)(0, base);
#endif
}
static inline Int load_ints(const __global int* base) {
#if WIDTH == 1
  return *base;
#else
  return LANE_JOIN(vload, WIDTH)(0, base);
#endif
}

// WIDTH consecutive words to `base`.
static inline void store_reals(__global float* base, Real v) {
#if WIDTH == 1
  *base = (float)v;
#else
  LANE_JOIN(vstore, WIDTH)(v, 0, base);
#endif
}
static inline void store_ints(__global int* base, Int v) {
#if WIDTH == 1
  *base = v;
#else
  LANE_JOIN(vstore, WIDTH)(v, 0, base);
#endif
}

// The same for tables in the precision of a Real; those above are of floats always.
#ifdef PHLUX_DOUBLE
static inline Real gather_scalar(const __global Scalar* base, Int index) { return base[index]; }
static inline Real load_scalars(const __global Scalar* base) { return *base; }
static inline void store_scalars(__global Scalar* base, Real v) { *base = v; }
#else
static inline Real gather_scalar(const __global Scalar* base, Int index) { return gather_real(base, index); }
static inline Real load_scalars(const __global Scalar* base) { return load_reals(base); }
static inline void store_scalars(__global Scalar* base, Real v) { store_reals(base, v); }
#endif

// ---- Across lanes

// The smallest of all lanes.
static inline Scalar min_of_lanes(Real v) {
#if WIDTH == 16
  const float8 v8 = fmin(v.lo, v.hi);
  const float4 v4 = fmin(v8.lo, v8.hi);
#elif WIDTH == 8
  const float4 v4 = fmin(v.lo, v.hi);
#elif WIDTH == 4
  const float4 v4 = v;
#endif
#if WIDTH == 1
  return v;
#else
  const float2 v2 = fmin(v4.lo, v4.hi);
  return fmin(v2.x, v2.y);
#endif
}

static inline uint sum_of_lanes(Uint v) {
#if WIDTH == 1
  return v;
#elif WIDTH == 4
  return v.s0 + v.s1 + v.s2 + v.s3;
#elif WIDTH == 8
  return v.s0 + v.s1 + v.s2 + v.s3 + v.s4 + v.s5 + v.s6 + v.s7;
#else
  return v.s0 + v.s1 + v.s2 + v.s3 + v.s4 + v.s5 + v.s6 + v.s7 + v.s8 + v.s9 + v.sa + v.sb + v.sc + v.sd + v.se + v.sf;
#endif
}

// The number of the first lane in m; some lane must be in it.
static inline int first_lane(Mask m) {
#if WIDTH == 1
  return 0;
#elif defined(LANES_AVX512)
  return (int)(31 - clz(lane_bits(m) & (0u - lane_bits(m))));
#else
  int array[WIDTH];
  int_lanes_to_array(m, array);
  int lane = 0;
  while (array[lane] == 0) ++lane;
  return lane;
#endif
}

static inline int count_lanes(Mask m) {
#ifdef LANES_AVX512
  return popcount((int)lane_bits(m));
#else
  return (int)sum_of_lanes(m ? (Uint)(1u) : (Uint)(0u));
#endif
}

// How many lanes of m stand before each lane of it; without meaning in other lanes.
static inline Int rank_lanes(Mask m) {
#ifdef LANES_AVX512
  return LANE_INTS(__builtin_ia32_expandsi512_mask(LANE_NATIVE_INTS(LANE_NUMBERS), LANE_NATIVE_INTS((Int)(0)),
                                                   (ushort)lane_bits(m)));
#elif WIDTH == 1
  return 0;
#else
  int chosen[WIDTH], rank[WIDTH];
  int_lanes_to_array(m, chosen);
  for (int lane = 0, count = 0; lane < WIDTH; ++lane) {
    rank[lane] = count;
    count += chosen[lane] != 0;
  }
  return int_lanes_from_array(rank);
#endif
}

// Moves the lanes of m to the front, in lane order; the others may hold anything.
static inline Real pack_lanes(Mask m, Real v) {
#ifdef LANES_AVX512
  return LANE_REALS(
      __builtin_ia32_compresssf512_mask(LANE_NATIVE_FLOATS(v), LANE_NATIVE_FLOATS((Real)(0.0f)), (ushort)lane_bits(m)));
#elif WIDTH == 1
  return v;
#else
  float from[WIDTH], to[WIDTH];
  int chosen[WIDTH];
  lanes_to_array(v, from);
  lanes_to_array((Real)(0.0f), to);
  int_lanes_to_array(m, chosen);
  for (int lane = 0, count = 0; lane < WIDTH; ++lane) {
    to[count] = from[lane];
    count += chosen[lane] != 0;
  }
  return lanes_from_array(to);
#endif
}
static inline Int pack_int_lanes(Mask m, Int v) { return carried_int(pack_lanes(m, carry_int(v))); }

// The other way round: the lanes of m take the first values of v, in lane order; the others keep `old`.
static inline Real unpack_lanes(Mask m, Real v, Real old) {
#ifdef LANES_AVX512
  return LANE_REALS(
      __builtin_ia32_expandsf512_mask(LANE_NATIVE_FLOATS(v), LANE_NATIVE_FLOATS(old), (ushort)lane_bits(m)));
#elif WIDTH == 1
  return m ? v : old;
#else
  float from[WIDTH], to[WIDTH];
  int chosen[WIDTH];
  lanes_to_array(v, from);
  lanes_to_array(old, to);
  int_lanes_to_array(m, chosen);
  for (int lane = 0, count = 0; lane < WIDTH; ++lane) {
    to[lane] = chosen[lane] ? from[count] : to[lane];
    count += chosen[lane] != 0;
  }
  return lanes_from_array(to);
#endif
}
static inline Int unpack_int_lanes(Mask m, Int v, Int old) {
  return carried_int(unpack_lanes(m, carry_int(v), carry_int(old)));
}

// Appends the keys and values of the lanes in m to two arrays, in lane order; the arrays have room for WIDTH more.
// Returns how many.
static inline int append_lanes(Mask m, Real key, Int value, Scalar* keys, int* values) {
  lanes_to_array(pack_lanes(m, key), keys);
  int_lanes_to_array(pack_int_lanes(m, value), values);
  return count_lanes(m);
}

// ---- Angles

// Cosine and sine of 2 pi turns, for turns in [0, 1]; both within 2 ulp of the larger. Polynomials fitted for the
// least relative error over an eighth of a turn to either side of the nearest quarter.
static inline void cos_sin_turns(Real turns, Real* cosine, Real* sine) {
#ifdef PHLUX_DOUBLE
  *cosine = cospi(2.0 * turns);
  *sine = sinpi(2.0 * turns);
#else
  const Real quarters = rint(4.0f * turns);
  const Real r = fma((Real)(4.0f), turns, -quarters);
  const Real r2 = r * r;
  const Real s = r * fma(r2, fma(r2, fma(r2, (Real)(-4.601663e-03f), (Real)(7.968003e-02f)), (Real)(-6.4596346e-01f)),
                         (Real)(1.57079632f));
  const Real c =
      fma(r2,
          fma(r2, fma(r2, fma(r2, (Real)(9.0336298e-04f), (Real)(-2.08599360e-02f)), (Real)(2.53669183e-01f)),
              (Real)(-1.23370054f)),
          (Real)(1.0f));
  const Int quadrant = to_int(quarters);
  const Mask odd = (quadrant & 1) != 0;
  const Real cosine_here = odd ? s : c, sine_here = odd ? c : s;
  *cosine = ((quadrant + 1) & 2) != 0 ? -cosine_here : cosine_here;
  *sine = (quadrant & 2) != 0 ? -sine_here : sine_here;
#endif
}

#endif
