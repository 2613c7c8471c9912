// A user's own reflectance model, that of Minnaert (1941), f_r = k (n + 2) / (2 pi) (cos theta_i cos
// theta_o)^n, which is reciprocal and reflects k cos^n theta_i. Sampled exactly. Its functions share no code,
// so that a mistake affects only one of them.
#pragma once

constexpr const char* minnaert_text = R"(#include "lobes/lobe.h"
#include "math/directions.h"

#define MINNAERT_PARAMETERS(COLOUR, NUMBER)                  \
  COLOUR(reflectance, 0.8, 0, 1, "fraction of light reflected along the normal") \
  NUMBER(exponent, 2, 0, 100, "n")
LOBE_STRUCT(Minnaert, MINNAERT)

static inline Real minnaert_power(Real cosine, Real n) { return exp(n * log(larger(cosine, (Real)(1e-30f)))); }

static inline Real minnaert_density(Minnaert m, Real cosine) {
  return (m.exponent + 2.0f) * (0.5f * INV_PI) * minnaert_power(cosine, m.exponent + 1.0f);
}

static inline LobeValue minnaert_evaluate(Minnaert m, Vec3 fixed, Vec3 generated) {
  const Real power = minnaert_power(fixed.z, m.exponent) * minnaert_power(generated.z, m.exponent);
  LobeValue v;
  v.value = vec_scale((m.exponent + 2.0f) * (0.5f * INV_PI) * power, m.reflectance);
  v.density = minnaert_density(m, generated.z);
  v.reverse = minnaert_density(m, fixed.z);
  return v;
}

static inline Vec3 minnaert_reflectivity(Minnaert m, Vec3 fixed) {
  return vec_scale(minnaert_power(fixed.z, m.exponent), m.reflectance);
}

static inline LobeSample minnaert_sample(Minnaert m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  LobeSample s;
  s.direction =
      cosine_power_direction(m.exponent + 1.0f, uniform_real(random.words.y), uniform_real(random.words.z));
  s.weight = vec_scale(minnaert_power(fixed.z, m.exponent), m.reflectance);
  s.density = (0.5f * m.exponent + 1.0f) * INV_PI * minnaert_power(s.direction.z, m.exponent + 1.0f);
  s.delta = NO_LANES;
  s.draws = (Int)(1);
  return s;
}
)";
