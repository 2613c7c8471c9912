// The modified Phong model (Lafortune and Willems, CW 197, 1994):
//
//     f_r = kd / pi + ks (n + 2) / (2 pi) cos^n(alpha)
//
// alpha is the angle between `generated` and the mirror image of `fixed`, clamped to pi / 2. The interface and the
// conventions are those of lobes/lobe.h.
//
// PHONG_STRATEGY is the file of the sampling strategy, such as "phong/strategies/exact.cl" or that of
// `--strategy FILE.cl`. A strategy defines
//
//   Real phong_density(Phong m, Vec3 fixed, Vec3 generated, Real lobe)     lobe: phong_lobe, which is reciprocal
//   LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active)
//   Real phong_survival(Phong m, Vec3 fixed, RandomDraws random)            of roulette
//
// sampling.md derives the formulas that are not in CW 197.
#ifndef PHLUX_PHONG_CL
#define PHLUX_PHONG_CL

#include "lobes/lobe.h"
#include "math/frames.h"

#define PHONG_PARAMETERS(COLOUR, NUMBER)                                                                               \
  COLOUR(diffuse_reflectance, 0.5, 0, 1, "kd")                                                                         \
  COLOUR(specular_reflectance, 0.2, 0, 1, "ks; kd + ks is at most 1 in every channel")                                 \
  NUMBER(exponent, 30, 0, 1e15, "n")
// The probabilities of the parts depend on the largest channels of kd and ks. The reflectivity of the lobe is tabulated
// over the cosine (host/lobes/phong.cpp): table_row is the index of the row's first value, table_scale the number of
// intervals per unit of cosine, and grazing_reflectivity is rho_s / ks at 90 degrees.
#define PHONG_DERIVED(NUMBER, INDEX)                                                                                   \
  NUMBER(diffuse_max) NUMBER(specular_max) NUMBER(table_scale) NUMBER(grazing_reflectivity) INDEX(table_row)
#define PHONG_SURVIVAL phong_survival
#define PHONG_TEXTURED phong_textured
LOBE_STRUCT(Phong, PHONG)

static inline Phong phong_textured(Phong m) {
  m.diffuse_max = vec_max(m.diffuse_reflectance);
  m.specular_max = vec_max(m.specular_reflectance);
  return m;
}

// Number of intervals in a row of the reflectivity table, one less than its values. Defined by the host, which fills
// the table.
#ifndef PHONG_TABLE_INTERVALS
#define PHONG_TABLE_INTERVALS 1024
#endif

// (n + 2) / 2 cos^n(alpha), 0 beyond pi / 2: f_r of the lobe for ks = pi. |generated - mirrored|^2 / 2 = 1 - cos(alpha)
// does not cancel: the relative error of the power is 1e-7 for every n; that of pow(dot, n) is 3e-2 at n = 1e6.
static inline Real phong_lobe(Phong m, Vec3 fixed, Vec3 generated) {
  const Real dx = generated.x + fixed.x, dy = generated.y + fixed.y, dz = generated.z - fixed.z;
  const Real one_minus_cosine = 0.5f * fma(dx, dx, fma(dy, dy, dz * dz));
  const Real power = exp(m.exponent * log1p(-one_minus_cosine));
  return one_minus_cosine < 1.0f ? fma(m.exponent, (Real)(0.5f), (Real)(1.0f)) * power : (Real)(0.0f);
}

// rho_s / ks, the reflectivity of the lobe at this cosine: the integral of CW 197, 3.3.1, which has a closed form
// (Arvo's double-axis moments). The error of linear interpolation in the table is at most 7e-5.
static inline Real phong_lobe_reflectivity(Phong m, Real cosine) {
  const Real position = cosine * m.table_scale;
  const Real below = smaller(floor(larger(position, (Real)(0.0f))), (Real)(PHONG_TABLE_INTERVALS - 1));
  const Int index = m.table_row + to_int(below);
  const Real v0 = gather_real(m.tables, index), v1 = gather_real(m.tables, index + 1);
  const Real tabulated = fma(position - below, v1 - v0, v0);
  return position < (float)PHONG_TABLE_INTERVALS ? tabulated : cosine;
}

// rho_d + rho_s.
static inline Vec3 phong_reflectivity(Phong m, Vec3 fixed) {
  return vec_along(m.diffuse_reflectance, phong_lobe_reflectivity(m, fixed.z), m.specular_reflectance);
}

// f_r from the value of phong_lobe.
static inline Vec3 phong_value(Phong m, Real lobe) {
  return vec_scale((Real)(INV_PI), vec_along(m.diffuse_reflectance, lobe, m.specular_reflectance));
}

#include PHONG_STRATEGY

static inline LobeValue phong_evaluate(Phong m, Vec3 fixed, Vec3 generated) {
  const Real lobe = phong_lobe(m, fixed, generated);
  LobeValue v;
  v.value = phong_value(m, lobe);
  v.density = phong_density(m, fixed, generated, lobe);
  v.reverse = phong_density(m, generated, fixed, lobe);
  return v;
}

#endif
