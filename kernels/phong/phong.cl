// The modified Phong reflectance model (Lafortune and Willems, CW 197, 1994): evaluate it, integrate it, sample it.
//
//     f_r = kd / pi + ks (n + 2) / (2 pi) cos^n(alpha)
//
// Directions are unit vectors in a frame whose z is the surface normal and point away from the surface. `fixed` is the
// direction that is known (towards the eye on an eye path, towards the light on a light path) and must lie above the
// surface; `generated` is the other one. The model is reciprocal, its sampling densities are not: they depend on which
// direction was fixed. alpha is the angle between `generated` and the mirror image of `fixed`, clamped to pi / 2.
// Densities are per solid angle. phong_sample takes the mask of the lanes that matter and draws for no others.
//
// STRATEGY chooses how phong_sample draws. HAS_PHONG_LOBE is 1 where some material has ks > 0; without
// it the model is kd / pi and no code of the lobe is compiled. phong-sampling.md derives what is not in CW 197.
#ifndef PHLUX_PHONG_CL
#define PHLUX_PHONG_CL

#include "math/constants.h"
#include "math/frames.h"
#include "math/random.h"
#include "math/directions.h"

#define STRATEGY_UNIFORM 1
#define STRATEGY_THETA_PHI 2
#define STRATEGY_COSINE 3
#define STRATEGY_DISK 4
#define STRATEGY_REJECTION 5
#define STRATEGY_LOBE_KS 6
#define STRATEGY_LOBE_ESTIMATE_PRINTED 7
#define STRATEGY_LOBE_ESTIMATE 8
#define STRATEGY_LOBE_RHO 9
#define STRATEGY_MIXTURE 10
#define STRATEGY_FOLD 11
#define STRATEGY_EXACT 12

// A path may reflect without loss where the reflectivity is 1; this lets roulette end it all the same.
#define PHONG_LARGEST_SURVIVAL 0.999f

// Intervals of a row of the reflectivity table; a row has one value more. The host that fills the table defines it.
#ifndef PHONG_TABLE_INTERVALS
#define PHONG_TABLE_INTERVALS 1024
#endif

// Material parameters in every lane. The largest colour channels decide how often each lobe is drawn.
typedef struct {
  Vec3 diffuse; // kd
#if HAS_PHONG_LOBE
  Vec3 specular;                  // ks
  Real exponent;                  // n >= 0
  Real diffuse_max, specular_max; // over the channels
  Real table_scale;               // table positions per unit of cosine: PHONG_TABLE_INTERVALS / min(1, 6 / sqrt(n + 1))
  Int table_row;                  // index of the row's first value
  const __global float* table;    // rows of rho_s / ks
  Real grazing_reflectivity;      // exact: rho_s / ks at 90 degrees
#endif
} Phong;

typedef struct {
  Vec3 direction; // may lie below the surface: then weight is 0
  Vec3 weight;    // f_r cos / (density x probability of surviving), per channel
  Real density;   // of `direction`, given that the path survives
  Mask survives;  // roulette: all lanes in which it was not asked for
  Int draws;      // directions that were drawn to find this one
} PhongSample;

// ---- The lobe

#if HAS_PHONG_LOBE

// (n + 2) / 2 cos^n(alpha), 0 beyond pi / 2: the lobe of f_r for ks = pi. |w - r|^2 / 2 = 1 - cos(alpha) without
// cancellation: right to 1e-7 at every n, where pow(dot(r, w), n) is off by 3e-2 at n = 1e6.
static inline Real phong_lobe(Phong m, Vec3 fixed, Vec3 generated) {
  const Real dx = generated.x + fixed.x, dy = generated.y + fixed.y, dz = generated.z - fixed.z;
  const Real one_minus_cosine = 0.5f * fma(dx, dx, fma(dy, dy, dz * dz));
  const Real power = exp(m.exponent * log1p(-one_minus_cosine));
  return one_minus_cosine < 1.0f ? fma(m.exponent, (Real)(0.5f), (Real)(1.0f)) * power : (Real)(0.0f);
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

#endif

// ---- Evaluation and integration

// f_r; 0 for a direction below the surface.
static inline Vec3 phong_eval(Phong m, Vec3 fixed, Vec3 generated) {
  Vec3 value = m.diffuse;
#if HAS_PHONG_LOBE
  value = vec_along(value, phong_lobe(m, fixed, generated), m.specular);
#endif
  const Mask above = (fixed.z > 0.0f) & (generated.z > 0.0f);
  return vec_select(above, vec_scale((Real)(INV_PI), value), vec_all((Real)(0.0f)));
}

// The fraction of the light from `fixed` that is reflected, per channel (rho_d + rho_s); cosine = fixed.z.
static inline Vec3 phong_reflectivity(Phong m, Real cosine) {
#if HAS_PHONG_LOBE
  return vec_along(m.diffuse, phong_lobe_reflectivity(m, cosine), m.specular);
#else
  return m.diffuse;
#endif
}

// Roulette: the probability with which the paths of `roulette` survive; all others do. `reflectivity` is the largest
// channel's: with the channels' mean a path between red walls would have infinite variance in red.
static inline Real survival_of(Real reflectivity, Mask roulette) {
  return roulette ? smaller(reflectivity, (Real)(PHONG_LARGEST_SURVIVAL)) : (Real)(1.0f);
}

// f_r cos / density / survival, of the whole model.
static inline Vec3 whole_weight(Phong m, Vec3 fixed, Vec3 direction, Real density, Real survival) {
  const Vec3 weight = vec_scale(direction.z / (density * survival), phong_eval(m, fixed, direction));
  return vec_select((direction.z > 0.0f) & (density > 0.0f), weight, vec_all((Real)(0.0f)));
}

// ---- Sampling without regard to the lobe

#if !HAS_PHONG_LOBE

static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
  return larger(generated.z, (Real)(0.0f)) * INV_PI;
}

static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomSequence sequence, Uint dimension, Mask roulette,
                                       Mask asked) {
  const RandomWords words = random_words(sequence, dimension, 0);
  const Real survival = survival_of(vec_max(m.diffuse), roulette);
  PhongSample s;
  s.direction = cosine_direction(uniform_real(words.y), uniform_real(words.z));
  s.density = s.direction.z * INV_PI;
  s.weight = vec_scale(1.0f / survival, m.diffuse);
  s.survives = uniform_real(words.x) < survival;
  s.draws = (Int)(1);
  return s;
}

#elif STRATEGY <= STRATEGY_DISK

static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
#if STRATEGY == STRATEGY_UNIFORM
  const Real density = (Real)(0.5f * INV_PI);
#elif STRATEGY == STRATEGY_THETA_PHI
  const Real density = (INV_PI * INV_PI) / sqrt(fma(generated.x, generated.x, generated.y * generated.y));
#else
  const Real density = generated.z * INV_PI;
#endif
  return generated.z > 0.0f ? density : (Real)(0.0f);
}

static inline Vec3 plain_direction(Real u1, Real u2) {
#if STRATEGY == STRATEGY_UNIFORM
  return hemisphere_direction(u1, u2);
#elif STRATEGY == STRATEGY_THETA_PHI
  return theta_phi_direction(u1, u2);
#elif STRATEGY == STRATEGY_COSINE
  return cosine_direction(u1, u2);
#else
  return disk_direction(u1, u2);
#endif
}

static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomSequence sequence, Uint dimension, Mask roulette,
                                       Mask asked) {
  const RandomWords words = random_words(sequence, dimension, 0);
  const Real survival = survival_of(vec_max(phong_reflectivity(m, fixed.z)), roulette);
  PhongSample s;
  s.direction = plain_direction(uniform_real(words.y), uniform_real(words.z));
  s.density = phong_density(m, fixed, s.direction);
  s.weight = whole_weight(m, fixed, s.direction, s.density, survival);
  s.survives = uniform_real(words.x) < survival;
  s.draws = (Int)(1);
  return s;
}

#else

// ---- Sampling one lobe or the other

typedef struct {
  Real diffuse, specular; // how often each lobe is drawn, up to a common factor
  Real survival;          // the probability with which a path survives roulette
} PhongShares;

// For a lobe that reflects `reflectivity` of what it would at normal incidence, or is taken to.
static inline PhongShares shares_for(Phong m, Real reflectivity) {
  PhongShares shares;
  shares.diffuse = m.diffuse_max;
  shares.specular = m.specular_max * reflectivity;
  shares.survival = vec_max(vec_along(m.diffuse, reflectivity, m.specular));
  return shares;
}

static inline PhongShares phong_shares(Phong m, Real cosine) {
#if STRATEGY == STRATEGY_LOBE_KS
  return shares_for(m, (Real)(1.0f));
#else
  return shares_for(m, phong_lobe_reflectivity(m, cosine));
#endif
}

#if STRATEGY == STRATEGY_EXACT || STRATEGY == STRATEGY_REJECTION

// The density is the model itself, f_r cos / rho, in the largest channels; a colourless material's weight is rho.
static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
  const PhongShares shares = phong_shares(m, fixed.z);
  const Real value = fma(phong_lobe(m, fixed, generated), m.specular_max, m.diffuse_max);
  return larger(generated.z, (Real)(0.0f)) * INV_PI * value / (shares.diffuse + shares.specular);
}

static inline PhongSample model_sample(Phong m, Vec3 fixed, Vec3 direction, PhongShares shares, Real survival) {
  const Real total = shares.diffuse + shares.specular;
  const Real lobe = phong_lobe(m, fixed, direction);
  const Real value = fma(lobe, m.specular_max, m.diffuse_max);
  const Vec3 colour = vec_along(m.diffuse, lobe, m.specular);
  PhongSample s;
  s.direction = direction;
  s.density = larger(direction.z, (Real)(0.0f)) * INV_PI * value / total;
  s.weight = vec_scale(total / survival, vec3(colour.x / value, colour.y / value, colour.z / value));
  s.weight = vec_select((direction.z > 0.0f) & (value > 0.0f), s.weight, vec_all((Real)(0.0f)));
  return s;
}

#endif

#if STRATEGY == STRATEGY_EXACT

// A direction with density cos^n(alpha) cos(theta), normalised (phong-sampling.md). In longitude psi and latitude beta
// of the mirror frame it separates into cos^(n + 2)(beta) and cos^n(psi) cos(psi + theta); the latter is a part that
// is even in psi (a) and one along the edge of the clamped region (b). `u1` and `u2` draw, `coin` decides between the
// parts and, within its part, again.
static inline Vec3 exact_direction(Phong m, Vec3 fixed, Real reflectivity, RandomSequence sequence, Uint dimension,
                                   Real u1, Real u2, Real coin, Mask asked, Int* draws) {
  const MirrorFrame frame = mirror_frame(fixed);
  const Real c = frame.cosine, s = frame.sine;
  const Real sine_power = exp((0.5f * m.exponent + 1.0f) * log1p(-c * c)); // s^(n + 2)
  const Real share_b = m.grazing_reflectivity * sine_power / reflectivity;
  const Mask in_b = asked & (coin < share_b);
  Vec3 v = cosine_power_direction(m.exponent + 1.0f, u1, u2), chosen = v;
  if (any_lane(in_b)) {
    // b: cos(psi) = s u^(1 / (n + 1)), towards the normal, at the same latitude.
    const Real minus_fall = expm1(2.0f * log(coin / share_b) / (m.exponent + 1.0f));
    const Real cos_beta = sqrt((1.0f - v.y) * (1.0f + v.y));
    const Vec3 b = vec3(-cos_beta * sqrt(fma(-s * s, minus_fall, c * c)), v.y, cos_beta * s * lobe_cosine(minus_fall));
    chosen = vec_select(in_b, b, chosen);
  }
  // a: v or its mirror image about psi = 0, in proportion to their heights; where the lower one is below the surface
  // half of the draws are refused.
  Mask drawing = asked & !in_b;
  Real again = (coin - share_b) / (1.0f - share_b);
  *draws = (Int)(1);
  for (uint draw = 1;; ++draw) {
    const Real side = fabs(v.x) * s, up = fma(v.z, c, side), down = fma(v.z, c, -side);
    const Real share_up = down > 0.0f ? up / (up + down) : (Real)(0.5f);
    const Mask takes_up = again < share_up;
    const Mask accepted = drawing & (takes_up | (down > 0.0f));
    chosen = vec_select(accepted, vec3(takes_up ? -fabs(v.x) : fabs(v.x), v.y, v.z), chosen);
    drawing &= !accepted;
    if (!any_lane(drawing)) break;
    const RandomWords words = random_words(sequence, dimension, draw);
    v = cosine_power_direction(m.exponent + 1.0f, uniform_real(words.y), uniform_real(words.z));
    again = uniform_real(words.w);
    *draws += drawing ? (Int)(1) : (Int)(0);
  }
  return from_mirror_frame(frame, chosen);
}

static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomSequence sequence, Uint dimension, Mask roulette,
                                       Mask asked) {
  const RandomWords words = random_words(sequence, dimension, 0);
  const Real reflectivity = phong_lobe_reflectivity(m, fixed.z);
  const PhongShares shares = shares_for(m, reflectivity);
  const Real survival = survival_of(shares.survival, roulette);
  const Real u = uniform_real(words.x), u1 = uniform_real(words.y), u2 = uniform_real(words.z);
  const Mask survives = u < survival;
  const Mask from_lobe = u * (shares.diffuse + shares.specular) >= survival * shares.diffuse;
  const Mask drawn = asked & survives & from_lobe;
  Vec3 direction = cosine_direction(u1, u2);
  Int draws = (Int)(1);
  if (any_lane(drawn)) {
    const Vec3 specular =
        exact_direction(m, fixed, reflectivity, sequence, dimension, u1, u2, uniform_real(words.w), drawn, &draws);
    direction = vec_select(drawn, specular, direction);
  }
  PhongSample s = model_sample(m, fixed, direction, shares, survival);
  s.survives = survives;
  s.draws = draws;
  return s;
}

#elif STRATEGY == STRATEGY_REJECTION

// Hit or miss against a bound of f_r cos, over the cosine density.
static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomSequence sequence, Uint dimension, Mask roulette,
                                       Mask asked) {
  const PhongShares shares = phong_shares(m, fixed.z);
  const Real survival = survival_of(shares.survival, roulette);
  const Real bound = fma(fma(m.exponent, (Real)(0.5f), (Real)(1.0f)), m.specular_max, m.diffuse_max);
  const RandomWords first = random_words(sequence, dimension, 0);
  RandomWords words = first;
  Vec3 direction = cosine_direction(uniform_real(words.y), uniform_real(words.z));
  Mask drawing = asked;
  Int draws = (Int)(1);
  for (uint draw = 1;; ++draw) {
    const Vec3 proposal = cosine_direction(uniform_real(words.y), uniform_real(words.z));
    direction = vec_select(drawing, proposal, direction);
    const Real value = fma(phong_lobe(m, fixed, proposal), m.specular_max, m.diffuse_max);
    drawing &= uniform_real(words.w) * bound >= value;
    if (!any_lane(drawing)) break;
    draws += drawing ? (Int)(1) : (Int)(0);
    words = random_words(sequence, dimension, draw);
  }
  PhongSample s = model_sample(m, fixed, direction, shares, survival);
  s.survives = uniform_real(first.x) < survival;
  s.draws = draws;
  return s;
}

#else

// Density of a direction when a lobe is drawn by its share. Where the share is an estimate, the density for its mean,
// which serves as well for weighting against other strategies.
static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated) {
  const PhongShares shares = phong_shares(m, fixed.z);
  Real lobe = phong_lobe(m, fixed, generated) * (m.exponent + 1.0f) / (m.exponent + 2.0f);
#if STRATEGY == STRATEGY_FOLD
  // Twice as dense where the mirror image about psi = 0 lies below the surface: there z c + x s of the mirror frame is
  // negative. x = -(p, q) . w c - s w.z and z = -(p, q) . w s + c w.z, so that is -2 c s (p, q) . w + (c^2 - s^2) w.z.
  const MirrorFrame f = mirror_frame(fixed);
  const Real along = fma(f.p, generated.x, f.q * generated.y);
  const Real image = fma(-2.0f * f.cosine * f.sine, along, (f.cosine - f.sine) * (f.cosine + f.sine) * generated.z);
  lobe = generated.z > 0.0f ? (image < 0.0f ? 2.0f * lobe : lobe) : (Real)(0.0f);
#endif
  const Real sum = fma(larger(generated.z, (Real)(0.0f)), shares.diffuse, lobe * shares.specular);
  return sum * INV_PI / (shares.diffuse + shares.specular);
}

// What a strategy takes for the reflectivity of the lobe in deciding on lobe and roulette.
static inline Real phong_guess(Phong m, Vec3 fixed, RandomSequence sequence, Uint dimension) {
#if STRATEGY == STRATEGY_LOBE_KS
  return (Real)(1.0f);
#elif STRATEGY == STRATEGY_LOBE_ESTIMATE || STRATEGY == STRATEGY_LOBE_ESTIMATE_PRINTED
  // CW 197, 3.3.1: one sample of the lobe, capped at 1; 0 when it falls below the surface. As printed the specular part
  // is then never taken and its energy is lost (biased); any guess that cannot be 0 is right.
  const RandomWords words = random_words(sequence, dimension, 1);
  const Vec3 v = cosine_power_direction(m.exponent, uniform_real(words.y), uniform_real(words.z));
  const Real height = mirror_frame_height(mirror_frame(fixed), v);
  const Real estimate = clamp((m.exponent + 2.0f) / (m.exponent + 1.0f) * height, (Real)(0.0f), (Real)(1.0f));
#if STRATEGY == STRATEGY_LOBE_ESTIMATE
  return 0.5f + 0.5f * estimate;
#else
  return estimate;
#endif
#else
  return phong_lobe_reflectivity(m, fixed.z);
#endif
}

// Draws one lobe by its share, then a direction from it.
static inline PhongSample phong_sample(Phong m, Vec3 fixed, RandomSequence sequence, Uint dimension, Mask roulette,
                                       Mask asked) {
  const RandomWords words = random_words(sequence, dimension, 0);
  const PhongShares shares = shares_for(m, phong_guess(m, fixed, sequence, dimension));
  const Real total = shares.diffuse + shares.specular, survival = survival_of(shares.survival, roulette);
  const Real u = uniform_real(words.x), u1 = uniform_real(words.y), u2 = uniform_real(words.z);
  const Mask from_lobe = u * total >= survival * shares.diffuse;
  Vec3 v = cosine_power_direction(m.exponent, u1, u2);
  const MirrorFrame frame = mirror_frame(fixed);
#if STRATEGY == STRATEGY_FOLD
  v.x = mirror_frame_height(frame, v) < 0.0f ? -v.x : v.x;
#endif
  PhongSample s;
  s.direction = vec_select(from_lobe, from_mirror_frame(frame, v), cosine_direction(u1, u2));
  s.density = phong_density(m, fixed, s.direction);
#if STRATEGY == STRATEGY_MIXTURE || STRATEGY == STRATEGY_FOLD
  s.weight = whole_weight(m, fixed, s.direction, s.density, survival);
#else
  // The part that was drawn, over its own density (CW 197, 3.3.2).
  const Real lobe = total / (survival * shares.specular) * (m.exponent + 2.0f) / (m.exponent + 1.0f) * s.direction.z;
  s.weight =
      vec_select(from_lobe, vec_scale(lobe, m.specular), vec_scale(total / (survival * shares.diffuse), m.diffuse));
  s.weight = vec_select((s.direction.z > 0.0f) & (total > 0.0f), s.weight, vec_all((Real)(0.0f)));
#endif
  s.survives = u < survival;
  s.draws = (Int)(1);
  return s;
}

#endif
#endif
#endif
