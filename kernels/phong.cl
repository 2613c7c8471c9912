// The modified Phong reflectance model (Lafortune and Willems, CW 197, 1994): evaluate it, integrate it, sample it.
//
//     f_r = kd / pi + ks (n + 2) / (2 pi) cos^n(alpha)
//
// Directions are unit vectors in a frame whose z is the surface normal and point away from the surface. `fixed` is the
// direction that is known (towards the eye on an eye path, towards the light on a light path) and must lie above the
// surface; `generated` is the other one. The model is reciprocal, its sampling densities are not: they depend on which
// direction was fixed. alpha is the angle between `generated` and the mirror image of `fixed`, clamped to pi / 2.
// Densities are per solid angle. Every function computes all lanes; a lane that is off may hold anything.
//
// PHLUX_STRATEGY chooses how phong_sample draws. PHLUX_PHONG_LOBE is defined where some material has ks > 0; without
// it the model is kd / pi and no code of the lobe is compiled.
#ifndef PHLUX_PHONG_CL
#define PHLUX_PHONG_CL

#include "frames.h"
#include "lanes.h"
#include "random.h"

#define STRATEGY_COSINE 1
#define STRATEGY_LOBE_KS 2
#define STRATEGY_LOBE_RHO 3
#define STRATEGY_MIXTURE 4

#define PHONG_PI 3.14159265358979f
#define PHONG_INV_PI 0.318309886183791f

// Intervals of a row of the reflectivity table; a row has one value more. The host that fills the table defines it.
#ifndef PHONG_TABLE_INTERVALS
#define PHONG_TABLE_INTERVALS 256
#endif

// Material parameters in every lane. The largest colour channels decide how often each lobe is drawn.
typedef struct {
  Vec3 diffuse; // kd
#ifdef PHLUX_PHONG_LOBE
  Vec3 specular;                  // ks
  Real exponent;                  // n >= 0
  Real diffuse_max, specular_max; // over the channels
  Real table_scale;               // table positions per unit of cosine: PHONG_TABLE_INTERVALS / min(1, 6 / sqrt(n + 1))
  Int table_row;                  // index of the row's first value
  const __global float* table;    // rows of rho_s / ks
#endif
} Phong;

typedef struct {
  Vec3 direction; // may lie below the surface: then weight is 0
  Vec3 weight;    // f_r cos / density, per channel
  Real density;   // of `direction` under the strategy
} PhongSample;

// ---- The lobe

#ifdef PHLUX_PHONG_LOBE

// cos^n(alpha), 0 beyond pi / 2. |w - r|^2 / 2 = 1 - cos(alpha) without cancellation: right to 1e-7 at every n, where
// pow(dot(r, w), n) is off by 3e-2 at n = 1e6.
static inline Real phong_cosine_power(Real exponent, Vec3 fixed, Vec3 generated) {
  const Real dx = generated.x + fixed.x, dy = generated.y + fixed.y, dz = generated.z - fixed.z;
  const Real one_minus_cosine = 0.5f * fma(dx, dx, fma(dy, dy, dz * dz));
  const Real power = exp(exponent * log1p(-one_minus_cosine));
  return one_minus_cosine < 1.0f ? power : (Real)(0.0f);
}

// rho_s / ks, the reflectivity of the lobe alone for the angle whose cosine is given: CW 197's integral, which has a
// closed form (Arvo's double-axis moments); tabulated by the host in double precision over the cosine.
static inline Real phong_lobe_reflectivity(Phong m, Real cosine) {
  const Real position = cosine * m.table_scale;
  const Real below = smaller(floor(larger(position, (Real)(0.0f))), (Real)(PHONG_TABLE_INTERVALS - 1));
  const Int index = m.table_row + to_int(below);
  const Real v0 = gather_real(m.table, index), v1 = gather_real(m.table, index + 1);
  const Real tabulated = fma(position - below, v1 - v0, v0);
  return position < (float)PHONG_TABLE_INTERVALS ? tabulated : cosine;
}

// A direction with density (n + 1) / (2 pi) cos^n(alpha). -expm1(2 log(u) / (n + 1)) is sin^2(alpha) to 1e-7 at every
// n; 1 - pow(u, 2 / (n + 1)) is not even of the right order at n = 1e4. The frame about the mirrored direction is
// built from components of `fixed` alone and cancels nowhere.
static inline Vec3 phong_sample_lobe(Real exponent, Vec3 fixed, Real u1, Real u2) {
  const Real minus_sine2 = expm1(2.0f * log(u1) / (exponent + 1.0f));
  const Real sine = sqrt(-minus_sine2), cosine = sqrt(1.0f + minus_sine2);
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  const Real s = sqrt(fma(fixed.x, fixed.x, fixed.y * fixed.y));
  const Mask tilted = s > 0.0f;
  const Real p = tilted ? fixed.x / s : (Real)(1.0f), q = tilted ? fixed.y / s : (Real)(0.0f);
  const Real c = fixed.z, x = sine * cos_phi, y = sine * sin_phi;
  const Real outward = fma(c, x, s * cosine); // along -(p, q)
  return vec3(fma(q, y, -p * outward), -fma(p, y, q * outward), fma(c, cosine, -s * x));
}

#endif

// ---- The four functions of a reflectance model

static inline Vec3 phong_cosine_sample(Real u1, Real u2) {
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  const Real sine = sqrt(1.0f - u1);
  return vec3(sine * cos_phi, sine * sin_phi, sqrt(u1));
}

// f_r; 0 for a direction below the surface.
static inline Vec3 phong_eval(Phong m, Vec3 fixed, Vec3 generated) {
  Vec3 value = vec_scale((Real)(PHONG_INV_PI), m.diffuse);
#ifdef PHLUX_PHONG_LOBE
  const Real lobe =
      (m.exponent + 2.0f) * (0.5f * PHONG_INV_PI) * phong_cosine_power(m.exponent, fixed, generated);
  value = vec_along(value, lobe, m.specular);
#endif
  return vec_select((fixed.z > 0.0f) & (generated.z > 0.0f), value, vec_all((Real)(0.0f)));
}

// The fraction of the light from `fixed` that is reflected, per channel (rho_d + rho_s); cosine = fixed.z.
static inline Vec3 phong_reflectivity(Phong m, Real cosine) {
#ifdef PHLUX_PHONG_LOBE
  return vec_along(m.diffuse, phong_lobe_reflectivity(m, cosine), m.specular);
#else
  return m.diffuse;
#endif
}

// The probability with which roulette should let a path live: what the strategy takes for the reflectivity, in the
// channel where it is largest. No channel's throughput can then rise over a bounce, whatever the colours; with the mean
// over the channels a path between red walls would have infinite variance in red.
static inline Real phong_survival(Phong m, Real cosine) {
#ifdef PHLUX_PHONG_LOBE
#if PHLUX_STRATEGY == STRATEGY_LOBE_KS
  return vec_max(vec_add(m.diffuse, m.specular));
#else
  return vec_max(phong_reflectivity(m, cosine));
#endif
#else
  return vec_max(m.diffuse);
#endif
}

#ifdef PHLUX_PHONG_LOBE

// How often each lobe is drawn, up to a common factor.
typedef struct {
  Real diffuse, specular;
} PhongShares;

static inline PhongShares phong_shares(Phong m, Real cosine) {
  PhongShares shares;
  shares.diffuse = m.diffuse_max;
#if PHLUX_STRATEGY == STRATEGY_LOBE_KS
  shares.specular = m.specular_max;
#else
  shares.specular = m.specular_max * phong_lobe_reflectivity(m, cosine);
#endif
  return shares;
}

#if PHLUX_STRATEGY == STRATEGY_COSINE

// The whole model, weighted by the cosine density.
static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
  return larger(generated.z, (Real)(0.0f)) * PHONG_INV_PI;
}

static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomWords words) {
  PhongSample s;
  s.direction = phong_cosine_sample(uniform_real(words.y), uniform_real(words.z));
  s.density = s.direction.z * PHONG_INV_PI;
  s.weight = vec_scale((Real)(PHONG_PI), phong_eval(m, fixed, s.direction));
  return s;
}

#else

// Density of a direction when a lobe is drawn by its share.
static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
  const PhongShares shares = phong_shares(m, fixed.z);
  const Real specular =
      (m.exponent + 1.0f) * 0.5f * phong_cosine_power(m.exponent, fixed, generated) * shares.specular;
  const Real sum = fma(larger(generated.z, (Real)(0.0f)), shares.diffuse, specular);
  return sum * PHONG_INV_PI / (shares.diffuse + shares.specular);
}

// Draws one lobe by its share, then a direction from it.
static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomWords words) {
  const PhongShares shares = phong_shares(m, fixed.z);
  const Real total = shares.diffuse + shares.specular;
  const Mask from_lobe = uniform_real(words.x) * total >= shares.diffuse;
  const Real u1 = uniform_real(words.y), u2 = uniform_real(words.z);
  PhongSample s;
  s.direction = vec_select(from_lobe, phong_sample_lobe(m.exponent, fixed, u1, u2), phong_cosine_sample(u1, u2));
  s.density = phong_density(m, fixed, s.direction);
#if PHLUX_STRATEGY == STRATEGY_MIXTURE
  // The whole model over the whole density: bounded by the larger of 1 and (n + 2) / (n + 1) in every channel's share.
  s.weight = vec_scale(s.direction.z / s.density, phong_eval(m, fixed, s.direction));
#else
  // The part that was drawn, over its own density (CW 197, 3.3.2).
  const Real specular_weight =
      total / shares.specular * (m.exponent + 2.0f) / (m.exponent + 1.0f) * s.direction.z;
  s.weight = vec_select(from_lobe, vec_scale(specular_weight, m.specular),
                        vec_scale(total / shares.diffuse, m.diffuse));
#endif
  s.weight = vec_select(s.direction.z > 0.0f, s.weight, vec_all((Real)(0.0f)));
  return s;
}

#endif
#else

static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
  return larger(generated.z, (Real)(0.0f)) * PHONG_INV_PI;
}

static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomWords words) {
  PhongSample s;
  s.direction = phong_cosine_sample(uniform_real(words.y), uniform_real(words.z));
  s.density = s.direction.z * PHONG_INV_PI;
  s.weight = m.diffuse;
  return s;
}

#endif
#endif
