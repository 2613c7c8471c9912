// Operations across lanes: tests of a mask, reductions, and compression of selected lanes.
#ifndef PHLUX_LANES_ACROSS_H
#define PHLUX_LANES_ACROSS_H

#include "lanes/memory.h"
#include "lanes/native.h"

// ---- Tests of a mask

#ifdef LANES_NATIVE
static inline int any_lane(Mask m) { return native_bits(m) != 0; }
static inline int all_lanes(Mask m) { return native_bits(m) == LANE_ALL_BITS; }
#elif WIDTH == 1
static inline int any_lane(Mask m) { return m != 0; }
static inline int all_lanes(Mask m) { return m != 0; }
#else
static inline int any_lane(Mask m) { return any(m); }
static inline int all_lanes(Mask m) { return all(m); }
#endif

// The smallest value of all lanes.
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

static inline Scalar max_of_lanes(Real v) { return -min_of_lanes(-v); }

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

// The number of the first lane in m, which must not be empty.
static inline int first_lane(Mask m) {
#if WIDTH == 1
  return 0;
#elif defined(LANES_NATIVE)
  return __builtin_ctz(native_bits(m));
#else
  int array[WIDTH];
  int_lanes_to_array(m, array);
  int lane = 0;
  while (array[lane] == 0) ++lane;
  return lane;
#endif
}

static inline int count_lanes(Mask m) {
#ifdef LANES_NATIVE
  return __builtin_popcount(native_bits(m));
#else
  return (int)sum_of_lanes(m ? (Uint)(1u) : (Uint)(0u));
#endif
}

// For each lane of m, the number of lanes of m before it; undefined in other lanes.
static inline Int rank_lanes(Mask m) {
#ifdef LANES_NATIVE
  return native_rank(m);
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

// Moves the values of the lanes of m to the first lanes, in lane order; the other lanes are undefined.
static inline Real pack_lanes(Mask m, Real v) {
#ifdef LANES_NATIVE
  return native_pack(m, v);
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

// The inverse: the lanes of m get the first values of v, in lane order; the others keep `old`.
static inline Real unpack_lanes(Mask m, Real v, Real old) {
#ifdef LANES_NATIVE
  return native_unpack(m, v, old);
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

// Appends the keys and values of the lanes in m to two arrays, in lane order; both need room for WIDTH more elements.
// Returns the number of lanes in m.
static inline int append_lanes(Mask m, Real key, Int value, Scalar* keys, int* values) {
  lanes_to_array(pack_lanes(m, key), keys);
  int_lanes_to_array(pack_int_lanes(m, value), values);
  return count_lanes(m);
}

#endif
