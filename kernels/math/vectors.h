// Vectors of three Reals.
#ifndef PHLUX_VECTORS_H
#define PHLUX_VECTORS_H

#include "lanes/lanes.h"
#include "math/constants.h"

typedef struct {
  Real x, y, z;
} Vec3;

static inline Vec3 vec3(Real x, Real y, Real z) {
  Vec3 v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
static inline Vec3 vec_all(Real s) { return vec3(s, s, s); }
static inline Vec3 vec_add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec_sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec_mul(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec3 vec_scale(Real s, Vec3 a) { return vec3(s * a.x, s * a.y, s * a.z); }
// a + s b
static inline Vec3 vec_along(Vec3 a, Real s, Vec3 b) {
  return vec3(fma(s, b.x, a.x), fma(s, b.y, a.y), fma(s, b.z, a.z));
}
static inline Real vec_dot(Vec3 a, Vec3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
static inline Vec3 vec_cross(Vec3 a, Vec3 b) {
  return vec3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x)));
}
static inline Vec3 vec_select(Mask m, Vec3 yes, Vec3 no) {
  return vec3(m ? yes.x : no.x, m ? yes.y : no.y, m ? yes.z : no.z);
}
static inline Vec3 vec_normalize(Vec3 a) { return vec_scale((Real)(1.0f) / sqrt(vec_dot(a, a)), a); }
// The angle between two unit vectors in radians, from half their distance: the cosine of a small angle is inaccurate.
static inline Real vec_angle(Vec3 a, Vec3 b) {
  const Mask acute = vec_dot(a, b) >= 0.0f;
  const Vec3 chord = vec_select(acute, vec_sub(a, b), vec_add(a, b));
  const Real angle = 2.0f * asin(0.5f * sqrt(vec_dot(chord, chord)));
  return acute ? angle : PI - angle;
}
static inline Real vec_max(Vec3 a) { return larger(a.x, larger(a.y, a.z)); }
static inline Real vec_sum(Vec3 a) { return a.x + a.y + a.z; }
static inline Real vec_mean(Vec3 a) { return (a.x + a.y + a.z) * (REAL(1.0) / 3.0f); }
static inline Real vec_largest(Vec3 a) { return larger(fabs(a.x), larger(fabs(a.y), fabs(a.z))); }

// ---- Memory access

// Three words of memory, the same in every lane.
static inline Vec3 broadcast_vec(const __global float* v) { return vec3((Real)(v[0]), (Real)(v[1]), (Real)(v[2])); }
// The same with `stride` words from one to the next.
static inline Vec3 broadcast_scalars(const __global Scalar* v, int stride) {
  return vec3((Real)(v[0]), (Real)(v[stride]), (Real)(v[2 * stride]));
}

// GATHER_REAL for a member of three words.
#define GATHER_VEC3(table, index, member)                                                                              \
  vec3(GATHER_REAL(table, index, member[0]), GATHER_REAL(table, index, member[1]), GATHER_REAL(table, index, member[2]))

// Three consecutive words of memory, from base[index] on, in every lane.
static inline Vec3 gather_vec(const __global float* base, Int index) {
  return vec3(gather_real(base, index), gather_real(base + 1, index), gather_real(base + 2, index));
}

static inline void scatter_vec(__global float* base, Int index, Vec3 v, Mask m) {
  scatter_real(base, index, v.x, m);
  scatter_real(base + 1, index, v.y, m);
  scatter_real(base + 2, index, v.z, m);
}

// Adds v to the vector `index` of `base`, of four words each, in the lanes of m, one lane after another: two lanes may
// share an index.
static inline void add_vec(__global float* base, Int index, Vec3 v, Mask m) {
  Scalar x[LANES], y[LANES], z[LANES];
  int at[LANES];
  const int count = count_lanes(m);
  lanes_to_array(pack_lanes(m, v.x), x);
  lanes_to_array(pack_lanes(m, v.y), y);
  lanes_to_array(pack_lanes(m, v.z), z);
  int_lanes_to_array(pack_int_lanes(m, index), at);
  for (int i = 0; i < count; ++i)
    vstore4(vload4((size_t)at[i], base) + (float4)((float)x[i], (float)y[i], (float)z[i], 0.0f), (size_t)at[i], base);
}

#endif
