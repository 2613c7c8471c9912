// The anisotropic Phong model (Ashikhmin and Shirley 2000): a lobe about the half vector with one exponent along each
// tangent, a Schlick Fresnel term, and a diffuse part that decreases where the lobe reflects more. The frame's x is the
// direction of exponent_u. It is sampled as the mixture of its two parts; the strategy has no effect.
#ifndef PHLUX_ANISOTROPICPHONG_CL
#define PHLUX_ANISOTROPICPHONG_CL

#include "lobes/lobe.h"

#define ANISOTROPICPHONG_PARAMETERS(COLOUR, NUMBER)                                                                    \
  COLOUR(diffuse_reflectance, 0.5, 0, 1, "Rd")                                                                         \
  COLOUR(specular_reflectance, 0.2, 0, 1, "Rs, the specular reflectance at normal incidence")                          \
  NUMBER(exponent_u, 30, 0, 1e30, "exponent along the first tangent")                                                  \
  NUMBER(exponent_v, 30, 0, 1e30, "exponent along the second tangent")
// The probabilities of the parts depend on the largest channels.
#define ANISOTROPICPHONG_DERIVED(NUMBER, INDEX) NUMBER(diffuse_max) NUMBER(specular_max)
#define ANISOTROPICPHONG_NEEDS_TANGENTS 1
#define ANISOTROPICPHONG_REFLECTIVITY_IS_ESTIMATE 1
#define ANISOTROPICPHONG_SURVIVAL anisotropicphong_survival
#define ANISOTROPICPHONG_TEXTURED anisotropicphong_textured
LOBE_STRUCT(Anisotropicphong, ANISOTROPICPHONG)

static inline Anisotropicphong anisotropicphong_textured(Anisotropicphong m) {
  m.diffuse_max = vec_max(m.diffuse_reflectance);
  m.specular_max = vec_max(m.specular_reflectance);
  return m;
}

static inline Real fifth_power(Real x) {
  const Real x2 = x * x;
  return x2 * x2 * x;
}

// Density of the half vector h, per solid angle of h.
static inline Real half_vector_density(Anisotropicphong m, Vec3 h) {
  const Real sine2 = fma(h.x, h.x, h.y * h.y);
  const Real exponent = fma(m.exponent_u * h.x, h.x, m.exponent_v * h.y * h.y) / sine2;
  const Real power = exp(exponent * 0.5f * log1p(-smaller(sine2, (Real)(ONE_MINUS_EPSILON))));
  return sqrt(m.exponent_u + 1.0f) * sqrt(m.exponent_v + 1.0f) * (0.5f * INV_PI) *
         (sine2 > 0.0f ? power : (Real)(1.0f));
}

// Estimates of the reflectivities of the parts, to which the probabilities of sampling them are proportional.
typedef struct {
  Real diffuse, specular;
} PartShares;

static inline PartShares part_shares(Anisotropicphong m, Real cosine) {
  PartShares shares;
  shares.specular = fma(1.0f - m.specular_max, fifth_power(1.0f - cosine), m.specular_max);
  shares.diffuse = m.diffuse_max * (1.0f - shares.specular);
  return shares;
}

static inline Real anisotropicphong_survival(Anisotropicphong m, Vec3 fixed, RandomDraws random) {
  const PartShares shares = part_shares(m, fixed.z);
  return shares.diffuse + shares.specular;
}

// The estimate of part_shares for every channel instead of the largest.
static inline Vec3 anisotropicphong_reflectivity(Anisotropicphong m, Vec3 fixed) {
  const Vec3 one = vec_all((Real)(1.0f));
  const Vec3 specular =
      vec_along(m.specular_reflectance, fifth_power(1.0f - fixed.z), vec_sub(one, m.specular_reflectance));
  return vec_add(specular, vec_mul(m.diffuse_reflectance, vec_sub(one, specular)));
}

// The density of the mixture; `specular` is the density of the lobe, that of the half vector divided by 4 h.k. It is 0
// if both shares are 0, as where textures make the material black.
static inline Real mixture_density(Anisotropicphong m, Real fixed_cosine, Real generated_cosine, Real specular) {
  const PartShares shares = part_shares(m, fixed_cosine);
  const Real sum = shares.diffuse * larger(generated_cosine, (Real)(0.0f)) * INV_PI + shares.specular * specular;
  return ratio_or_zero(sum, shares.diffuse + shares.specular);
}

static inline LobeValue anisotropicphong_evaluate(Anisotropicphong m, Vec3 fixed, Vec3 generated) {
  const Vec3 sum = vec_add(fixed, generated);
  const Real length = sqrt(vec_dot(sum, sum));
  const Real half_vector = half_vector_density(m, vec_scale(1.0f / length, sum));
  const Real hk = 0.5f * length; // h . fixed = h . generated, computed symmetrically
  const Real lobe = half_vector / (4.0f * hk * larger(fixed.z, generated.z));
  const Real grazing = fifth_power(1.0f - hk);
  const Vec3 not_specular = vec_sub(vec_all((Real)(1.0f)), m.specular_reflectance);
  const Vec3 fresnel = vec_along(m.specular_reflectance, grazing, not_specular);
  const Real under = (REAL(28.0) / 23.0f * INV_PI) * (1.0f - fifth_power(1.0f - 0.5f * fixed.z)) *
                     (1.0f - fifth_power(1.0f - 0.5f * generated.z));
  LobeValue v;
  v.value = vec_along(vec_scale(lobe, fresnel), under, vec_mul(m.diffuse_reflectance, not_specular));
  const Real specular = half_vector / (2.0f * length);
  v.density = mixture_density(m, fixed.z, generated.z, specular);
  v.reverse = mixture_density(m, generated.z, fixed.z, specular);
  return v;
}

static inline LobeSample anisotropicphong_sample(Anisotropicphong m, Vec3 fixed, Real choice, RandomDraws random,
                                                 Mask active) {
  const PartShares shares = part_shares(m, fixed.z);
  const Mask from_lobe = choice * (shares.diffuse + shares.specular) >= shares.diffuse;
  const Real u1 = uniform_real(random.words.y), u2 = uniform_real(random.words.z);
  // Longitude: a uniform angle, stretched by the exponents, without a distinction of quadrants.
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
  const Vec3 direction = vec_select(from_lobe, mirrored, cosine_direction(u1, u2));
  LobeSample s = lobe_sample(direction, anisotropicphong_evaluate(m, fixed, direction));
  // A half vector with h . fixed < 0 gives a direction below the surface.
  s.direction.z = ((direction.z > 0.0f) & ((hk > 0.0f) | !from_lobe)) ? direction.z : (Real)(-1.0f);
  return s;
}

#endif
