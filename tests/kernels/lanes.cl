#include "math/vectors.h"

typedef struct {
  int a;
  float b;
  int c;
} Row;

__kernel void gather(__global float* reals, __global int* ints, __global Row* rows, __global const Int* index,
                     __global Real* real, __global Int* whole, __global Real* b, __global Int* c) {
  const size_t i = get_global_id(0);
  real[i] = gather_real(reals, index[i]);
  whole[i] = gather_int(ints, index[i]);
  b[i] = GATHER_REAL(rows, index[i], b);
  c[i] = GATHER_INT(rows, index[i], c);
}

__kernel void scatter(__global float* base, __global const Int* index, __global const Real* value,
                      __global const Int* chosen) {
  const size_t i = get_global_id(0);
  scatter_real(base, index[i], value[i], chosen[i] != 0);
}

// Two appends in succession: the entries and their number.
__kernel void append(__global const Int* first, __global const Int* second, __global const Real* key,
                     __global const Int* value, __global float* keys, __global int* values, __global int* counts) {
  const size_t i = get_global_id(0);
  float my_keys[3 * LANES];
  int my_values[3 * LANES];
  for (int k = 0; k < 3 * LANES; ++k) {
    my_keys[k] = -1.0f;
    my_values[k] = -1;
  }
  int count = append_lanes(first[i] != 0, key[i], value[i], my_keys, my_values);
  count += append_lanes(second[i] != 0, key[i] + 1000.0f, value[i] + 1000, my_keys + count, my_values + count);
  counts[i] = count;
  for (int k = 0; k < 2 * LANES; ++k) {
    keys[i * (2 * LANES) + k] = k < count ? my_keys[k] : 0.0f;
    values[i * (2 * LANES) + k] = k < count ? my_values[k] : 0;
  }
}

__kernel void across(__global const Int* chosen, __global const Real* real, __global const Uint* whole,
                     __global int* any_of, __global int* all_of, __global int* first, __global float* least,
                     __global uint* sum) {
  const size_t i = get_global_id(0);
  const Mask m = chosen[i] != 0;
  any_of[i] = any_lane(m) != 0;
  all_of[i] = all_lanes(m) != 0;
  first[i] = any_lane(m) ? first_lane(m) : -1;
  least[i] = min_of_lanes(real[i]);
  sum[i] = sum_of_lanes(whole[i]);
}

__kernel void arrays(__global const Real* real, __global const Int* whole, __global Real* real_back,
                     __global Int* whole_back, __global Int* number) {
  const size_t i = get_global_id(0);
  float reals[LANES];
  int ints[LANES];
  lanes_to_array(real[i], reals);
  int_lanes_to_array(whole[i], ints);
  real_back[i] = lanes_from_array(reals) + load_reals((const __global float*)(real + i));
  whole_back[i] = int_lanes_from_array(ints) + load_ints((const __global int*)(whole + i));
  number[i] = LANE_NUMBERS;
}

__kernel void products(__global const Uint* a, uint factor, __global Uint* high, __global Uint* low) {
  const size_t i = get_global_id(0);
  Uint h, l;
  multiply_wide(a[i], factor, &h, &l);
  high[i] = h;
  low[i] = l;
}

__kernel void quotients(__global const Int* a, int b, __global Int* q) {
  const size_t i = get_global_id(0);
  q[i] = quotient(a[i], b);
}

__kernel void signs(__global const Real* x, __global const Real* sign, __global Real* product, __global Real* larger_of,
                    __global Real* smaller_of) {
  const size_t i = get_global_id(0);
  product[i] = times_sign(x[i], sign[i]);
  larger_of[i] = larger(x[i], sign[i]);
  smaller_of[i] = smaller(x[i], sign[i]);
}

typedef struct {
  Int both, either, not_less, none, all, real, whole, vec;
} Selections;

__kernel void masks(__global const Real* a, __global const Real* b, __global Selections* selections) {
  const size_t i = get_global_id(0);
  const Mask less = a[i]<b[i], positive = a[i]> 0.0f;
  const Int yes = (Int)(1), no = (Int)(0);
  Selections s;
  s.both = (less & positive) ? yes : no;
  s.either = (less | positive) ? yes : no;
  s.not_less = !less ? yes : no;
  s.none = NO_LANES ? yes : no;
  s.all = (ALL_LANES & !NO_LANES) ? yes : no;
  s.real = to_int(less ? a[i] : b[i]);
  s.whole = uint_to_int(less ? int_to_uint(to_int(a[i])) : int_to_uint(to_int(b[i])));
  // The lanes that are not selected hold NaN.
  const Vec3 bad = vec_all((Real)(NAN));
  const Vec3 good = vec3(a[i], b[i], (Real)(2.0f));
  const Vec3 chosen = vec_select(less, good, vec_select(!less, vec_scale((Real)(2.0f), good), bad));
  s.vec = to_int(chosen.x + chosen.y + chosen.z);
  selections[i] = s;
}

__kernel void packs(__global const Int* chosen, __global const Real* real, __global const Int* whole,
                    __global const Real* old, __global int* count, __global Int* rank, __global Real* packed,
                    __global Int* packed_int, __global Real* unpacked) {
  const size_t i = get_global_id(0);
  const Mask m = chosen[i] != 0;
  count[i] = count_lanes(m);
  rank[i] = rank_lanes(m);
  packed[i] = pack_lanes(m, real[i]);
  packed_int[i] = pack_int_lanes(m, whole[i]);
  unpacked[i] = unpack_lanes(m, real[i], old[i]);
}

__kernel void scatter_and_add(__global int* ints, __global float* sums, __global const Int* index,
                              __global const Int* whole, __global const Real* real, __global const Int* chosen) {
  const size_t i = get_global_id(0);
  scatter_int(ints, index[i], whole[i], chosen[i] != 0);
  add_vec(sums, index[i], vec3(real[i], 2.0f * real[i], -real[i]), chosen[i] != 0);
}

__kernel void stores(__global const Real* real, __global const Int* whole, __global float* reals, __global int* ints) {
  const size_t i = get_global_id(0);
  store_reals(reals + i * LANES, real[i]);
  store_ints(ints + i * LANES, whole[i]);
}

// A table of 16 rows of three words, entries looked up in it by lane: by gathers where registers are not permuted.
__kernel void permutes(__global Row* rows, __global const Int* index, __global Real* b, __global Int* c) {
  const size_t i = get_global_id(0);
#if LANES_PERMUTE
  float members[3][TABLE_ENTRIES];
  load_members(rows, 3, members);
  b[i] = PERMUTE_REAL(members, rows, index[i], b);
  c[i] = PERMUTE_INT(members, rows, index[i], c);
#else
  b[i] = GATHER_REAL(rows, index[i], b);
  c[i] = GATHER_INT(rows, index[i], c);
#endif
}
