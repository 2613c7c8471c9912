// A retroreflector, such as a road sign: the modified Phong model with its lobe about the direction that the light comes
// from, where the Phong lobe is about the mirror image of that direction:
//
//     f_r = R ((1 - s) / pi + s (n + 2) / (2 pi) cos^n(alpha)),   alpha: angle between the two directions, at most pi / 2
//
// alpha does not change when the directions are exchanged, so that the model is reciprocal. Half a turn about the normal
// takes the lobe to the Phong lobe and keeps cos(theta): both reflect rho_s <= 1, and the whole reflects at most R.
#include "lobes/lobe.h"
#include "math/frames.h"
#include "phong/reflectivity.h"

#define RETRO_PARAMETERS(COLOUR, NUMBER)                                                                               \
  COLOUR(reflectance, 0.8, 0, 1, "R")                                                                                  \
  NUMBER(share, 0.8, 0, 1, "s, the part of it that is sent back")                                                      \
  NUMBER(exponent, 100, 1, 1e6, "n")
LOBE_STRUCT(Retro, RETRO)

// cos^n(alpha). |fixed - generated|^2 / 2 = 1 - cos(alpha) does not cancel.
static inline Real retro_power(Retro m, Vec3 fixed, Vec3 generated) {
  const Vec3 difference = vec_sub(fixed, generated);
  const Real one_minus_cosine = 0.5f * vec_dot(difference, difference);
  return one_minus_cosine < 1.0f ? exp(m.exponent * log1p(-one_minus_cosine)) : (Real)(0.0f);
}

// The diffuse part is sampled by cos(theta) / pi, the lobe by (n + 1) / (2 pi) cos^n(alpha).
static inline Real retro_density(Retro m, Real cosine, Real power) {
  return INV_PI * fma(m.share, 0.5f * (m.exponent + 1.0f) * power, (1.0f - m.share) * larger(cosine, (Real)(0.0f)));
}

static inline LobeValue retro_evaluate(Retro m, Vec3 fixed, Vec3 generated) {
  const Real power = retro_power(m, fixed, generated);
  const Real value = INV_PI * fma(m.share, (0.5f * m.exponent + 1.0f) * power, 1.0f - m.share);
  LobeValue v;
  v.value = vec_scale(value, m.reflectance);
  v.density = retro_density(m, generated.z, power);
  v.reverse = retro_density(m, fixed.z, power);
  return v;
}

static inline LobeSample retro_sample(Retro m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Real u1 = uniform_real(random.words.y), u2 = uniform_real(random.words.z);
  const Vec3 about_fixed = from_frame(frame_about(fixed), cosine_power_direction(m.exponent, u1, u2));
  const Vec3 direction = vec_select(choice < m.share, about_fixed, cosine_direction(u1, u2));
  return lobe_sample(direction, retro_evaluate(m, fixed, direction));
}

static inline Vec3 retro_reflectivity(Retro m, Vec3 fixed) {
  return vec_scale(fma(m.share, phong_reflectivity_of(m.exponent, fixed.z), 1.0f - m.share), m.reflectance);
}
