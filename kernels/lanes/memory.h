// Memory access of lanes: gathers, scatters, consecutive words, and small tables in registers.
#ifndef PHLUX_LANES_MEMORY_H
#define PHLUX_LANES_MEMORY_H

#include "lanes/avx512.h"
#include "lanes/types.h"

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

// table[index].member in every lane, for a __global array of structs of 4-byte members. The member is addressed from
// the start of the table, so that no array member is indexed beyond its end.
#define MEMBER_PLACE(type, table, member) (int)((const __global type*)&(table)->member - (const __global type*)(table))
#define GATHER_REAL(table, index, member)                                                                              \
  gather_real((const __global float*)(table),                                                                          \
              (index) * (int)(sizeof(*(table)) / 4) + MEMBER_PLACE(float, table, member))
#define GATHER_INT(table, index, member)                                                                               \
  gather_int((const __global int*)(table), (index) * (int)(sizeof(*(table)) / 4) + MEMBER_PLACE(int, table, member))

static inline void float_lanes_to_array(Real v, float* array) {
#if WIDTH == 1
  *array = (float)v;
#else
  LANE_JOIN(vstore, WIDTH)(v, 0, array);
#endif
}

// A table of at most LANES structs of 4-byte members can be stored in private memory, one array per member. A lookup
// then permutes a register, which is many times as fast as a gather. LANES_PERMUTE is 1 if the device has such
// permutations.
#ifdef LANES_AVX512
#define LANES_PERMUTE 1
#else
#define LANES_PERMUTE 0
#endif
static inline Real permute_real(const float* base, Int index) {
#ifdef LANES_AVX512
  return LANE_REALS(__builtin_ia32_permvarsf512(LANE_NATIVE_FLOATS(vload16(0, base)), LANE_NATIVE_INTS(index)));
#elif WIDTH == 1
  return base[index];
#else
  return (Real)(LANE_EACH(LANE_LOAD));
#endif
}
static inline Int permute_int(const float* base, Int index) { return carried_int(permute_real(base, index)); }
// The table has room for LANES entries of `words` words each.
static inline void load_members(const __global void* table, int words, float (*members)[LANES]) {
  for (int word = 0; word < words; ++word)
    float_lanes_to_array(gather_real((const __global float*)table, LANE_NUMBERS * words + word), members[word]);
}
#define PERMUTE_REAL(members, table, index, member) permute_real((members)[MEMBER_PLACE(float, table, member)], index)
#define PERMUTE_INT(members, table, index, member) permute_int((members)[MEMBER_PLACE(int, table, member)], index)

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

// Private copies of lanes, for loops over them.
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

// The same for tables in the precision of a Real; those above always contain floats.
#ifdef PHLUX_DOUBLE
static inline Real gather_scalar(const __global Scalar* base, Int index) { return base[index]; }
static inline Real load_scalars(const __global Scalar* base) { return *base; }
static inline void store_scalars(__global Scalar* base, Real v) { *base = v; }
#else
static inline Real gather_scalar(const __global Scalar* base, Int index) { return gather_real(base, index); }
static inline Real load_scalars(const __global Scalar* base) { return load_reals(base); }
static inline void store_scalars(__global Scalar* base, Real v) { store_reals(base, v); }
#endif

#endif
