// Anisotropic Phong (Ashikhmin and Shirley 2000): a lobe about the half vector with one exponent along each tangent, a
// Schlick Fresnel term, and a diffuse part that gives way to it at grazing angles. Conventions as in phong.cl; the
// frame's x is the direction of exponent_u. Every strategy draws it as its own mixture of the two parts.
#ifndef PHLUX_ANISOTROPIC_CL
#define PHLUX_ANISOTROPIC_CL

#include "phong/phong.cl"

#if HAS_ANISOTROPIC

typedef struct {
  Vec3 diffuse, specular; // Rd, Rs
  Real exponent_u, exponent_v;
  Real diffuse_max, specular_max;
} Anisotropic;

static inline Real fifth_power(Real x) {
  const Real x2 = x * x;
  return x2 * x2 * x;
}

// Density of the half vector h, per solid angle about h.
static inline Real half_vector_density(Anisotropic m, Vec3 h) {
  const Real sine2 = fma(h.x, h.x, h.y * h.y);
  const Real exponent = fma(m.exponent_u * h.x, h.x, m.exponent_v * h.y * h.y) / sine2;
  const Real power = exp(exponent * 0.5f * log1p(-smaller(sine2, (Real)(1.0f))));
  return sqrt((m.exponent_u + 1.0f) * (m.exponent_v + 1.0f)) * (0.5f * INV_PI) *
         (sine2 > 0.0f ? power : (Real)(1.0f));
}

static inline Vec3 anisotropic_eval(Anisotropic m, Vec3 fixed, Vec3 generated) {
  const Vec3 sum = vec_add(fixed, generated);
  const Real length = sqrt(vec_dot(sum, sum));
  const Vec3 h = vec_scale(1.0f / length, sum);
  const Real hk = 0.5f * length; // h . fixed = h . generated, without favouring either
  const Real lobe = half_vector_density(m, h) / (4.0f * hk * larger(fixed.z, generated.z));
  const Real grazing = fifth_power(1.0f - hk);
  const Vec3 fresnel =
      vec3(fma(1.0f - m.specular.x, grazing, m.specular.x), fma(1.0f - m.specular.y, grazing, m.specular.y),
           fma(1.0f - m.specular.z, grazing, m.specular.z));
  const Real under = (REAL(28.0) / 23.0f * INV_PI) * (1.0f - fifth_power(1.0f - 0.5f * fixed.z)) *
                     (1.0f - fifth_power(1.0f - 0.5f * generated.z));
  const Vec3 base = vec3(m.diffuse.x * (1.0f - m.specular.x), m.diffuse.y * (1.0f - m.specular.y),
                         m.diffuse.z * (1.0f - m.specular.z));
  const Vec3 value = vec_along(vec_scale(lobe, fresnel), under, base);
  return vec_select((fixed.z > 0.0f) & (generated.z > 0.0f), value, vec_all((Real)(0.0f)));
}

// What each part reflects, roughly: how often it is drawn.
typedef struct {
  Real diffuse, specular;
} LobeShares;

static inline LobeShares anisotropic_shares(Anisotropic m, Real cosine) {
  LobeShares shares;
  shares.specular = fma(1.0f - m.specular_max, fifth_power(1.0f - cosine), m.specular_max);
  shares.diffuse = m.diffuse_max * (1.0f - shares.specular);
  return shares;
}

static inline Real anisotropic_density(Anisotropic m, Vec3 fixed, Vec3 generated) {
  const LobeShares shares = anisotropic_shares(m, fixed.z);
  const Vec3 sum = vec_add(fixed, generated);
  const Real length = sqrt(vec_dot(sum, sum));
  const Real specular = half_vector_density(m, vec_scale(1.0f / length, sum)) / (2.0f * length);
  return (shares.diffuse * larger(generated.z, (Real)(0.0f)) * INV_PI + shares.specular * specular) /
         (shares.diffuse + shares.specular);
}

static inline PhongSample anisotropic_sample(Anisotropic m, Vec3 fixed, RandomSequence sequence, Uint dimension,
                                             Mask roulette) {
  const RandomWords words = random_words(sequence, dimension, 0);
  const LobeShares shares = anisotropic_shares(m, fixed.z);
  const Real total = shares.diffuse + shares.specular, survival = survival_of(total, roulette);
  const Real u = uniform_real(words.x);
  const Mask from_lobe = u * total >= survival * shares.diffuse;
  const Real u1 = uniform_real(words.y), u2 = uniform_real(words.z);
  // Longitude: an angle uniform over the circle, stretched by the exponents; no quadrant needs a case of its own.
  Real cos_turn, sin_turn;
  cos_sin_turns(u2, &cos_turn, &sin_turn);
  const Real along_u = cos_turn * sqrt(m.exponent_v + 1.0f), along_v = sin_turn * sqrt(m.exponent_u + 1.0f);
  const Real scale = 1.0f / sqrt(fma(along_u, along_u, along_v * along_v));
  const Real cos_phi = along_u * scale, sin_phi = along_v * scale;
  const Real exponent = fma(m.exponent_u * cos_phi, cos_phi, m.exponent_v * sin_phi * sin_phi);
  const Real minus_sine2 = expm1(2.0f * log(u1) / (exponent + 1.0f));
  const Real sine = sqrt(-minus_sine2);
  const Vec3 h = vec3(sine * cos_phi, sine * sin_phi, lobe_cosine(minus_sine2));
  const Real hk = vec_dot(h, fixed);
  const Vec3 mirrored = vec_along(vec_scale((Real)(-1.0f), fixed), 2.0f * hk, h);
  PhongSample s;
  s.direction = vec_select(from_lobe, mirrored, cosine_direction(u1, u2));
  s.density = anisotropic_density(m, fixed, s.direction);
  // A half vector that fixed cannot see gives a direction below the surface.
  const Mask above = (s.direction.z > 0.0f) & ((hk > 0.0f) | !from_lobe);
  s.direction.z = above ? s.direction.z : (Real)(-1.0f);
  s.weight =
      vec_select(above, vec_scale(s.direction.z / (s.density * survival), anisotropic_eval(m, fixed, s.direction)),
                 vec_all((Real)(0.0f)));
  s.survives = u < survival;
  s.draws = (Int)(1);
  return s;
}

#endif
#endif
