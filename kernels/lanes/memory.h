// Memory access of lanes: gathers, scatters, consecutive words, and small tables in registers.
#ifndef PHLUX_LANES_MEMORY_H
#define PHLUX_LANES_MEMORY_H

#include "lanes/native.h"
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
#ifdef LANES_GATHER
  return native_gather(base, index);
#elif WIDTH == 1
  return base[index];
#else
#define LANE_LOAD(k) base[index.s##k]
  return (Real)(LANE_EACH(LANE_LOAD));
#endif
}

static inline Int gather_int(const __global int* base, Int index) {
#ifdef LANES_GATHER
  return native_gather_int(base, index);
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

// The words of all lanes, at any address of a word. The vload and vstore of OpenCL C are functions of the driver's
// library, which it may not inline (see inlined.h).
#if WIDTH == 1
typedef float FloatWords;
typedef Scalar ScalarWords;
typedef int IntWords;
#else
typedef Real FloatWords __attribute__((aligned(4)));
typedef FloatWords ScalarWords;
typedef Int IntWords __attribute__((aligned(4)));
#endif

static inline void float_lanes_to_array(Real v, float* array) { *(FloatWords*)array = (FloatWords)v; }

// A table of at most TABLE_ENTRIES structs of 4-byte members can be stored in private memory, one array per member, if
// LANES_PERMUTE is 1: the device has permutations of registers. A lookup is then many times as fast as a gather.
#ifdef LANES_NATIVE
#define LANES_PERMUTE 1
#define TABLE_ENTRIES 16
#else
#define LANES_PERMUTE 0
#define TABLE_ENTRIES LANES
#endif
static inline Real permute_real(const float* base, Int index) {
#if LANES_PERMUTE && WIDTH == TABLE_ENTRIES
  return native_permute(*(const FloatWords*)base, index);
#elif LANES_PERMUTE
  const Real first = native_permute(*(const FloatWords*)base, index);
  const Real second = native_permute(*(const FloatWords*)(base + WIDTH), index);
  return index < WIDTH ? first : second;
#elif WIDTH == 1
  return base[index];
#else
  return (Real)(LANE_EACH(LANE_LOAD));
#endif
}
static inline Int permute_int(const float* base, Int index) { return carried_int(permute_real(base, index)); }
// The table has room for TABLE_ENTRIES entries of `words` words each.
static inline void load_members(const __global void* table, int words, float (*members)[TABLE_ENTRIES]) {
  for (int word = 0; word < words; ++word)
    for (int entry = 0; entry < TABLE_ENTRIES; entry += LANES)
      float_lanes_to_array(gather_real((const __global float*)table, (LANE_NUMBERS + entry) * words + word),
                           members[word] + entry);
}
#define PERMUTE_REAL(members, table, index, member) permute_real((members)[MEMBER_PLACE(float, table, member)], index)
#define PERMUTE_INT(members, table, index, member) permute_int((members)[MEMBER_PLACE(int, table, member)], index)

// base[index] = value in the lanes of m, in lane order.
static inline void scatter_real(__global float* base, Int index, Real value, Mask m) {
#ifdef LANES_GATHER
  native_scatter(base, index, value, m);
#elif WIDTH == 1
  if (m) base[index] = (float)value;
#else
#define LANE_STORE(k) (m.s##k ? (void)(base[index.s##k] = value.s##k) : (void)0)
  LANE_EACH(LANE_STORE);
#endif
}

static inline void scatter_int(__global int* base, Int index, Int value, Mask m) {
#ifdef LANES_GATHER
  native_scatter_int(base, index, value, m);
#elif WIDTH == 1
  if (m) base[index] = value;
#else
  LANE_EACH(LANE_STORE);
#endif
}

// Private copies of lanes, for loops over them.
static inline void lanes_to_array(Real v, Scalar* array) { *(ScalarWords*)array = v; }
static inline void int_lanes_to_array(Int v, int* array) { *(IntWords*)array = v; }
static inline Real lanes_from_array(const Scalar* array) { return *(const ScalarWords*)array; }
static inline Int int_lanes_from_array(const int* array) { return *(const IntWords*)array; }

// base[index] in every lane, of a private array.
static inline Real array_reals(const Scalar* base, Int index) {
#ifdef LANES_GATHER
  return native_gather((const __global float*)(size_t)base, index);
#elif WIDTH == 1
  return base[index];
#else
  return (Real)(LANE_EACH(LANE_LOAD));
#endif
}

// WIDTH consecutive words from `base`.
static inline Real load_reals(const __global float* base) { return *(const __global FloatWords*)base; }
static inline Int load_ints(const __global int* base) { return *(const __global IntWords*)base; }

// WIDTH consecutive words to `base`.
static inline void store_reals(__global float* base, Real v) { *(__global FloatWords*)base = (FloatWords)v; }
static inline void store_ints(__global int* base, Int v) { *(__global IntWords*)base = v; }

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
