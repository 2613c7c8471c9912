// The diffuse (Lambertian) model: f_r = reflectance / pi, sampled with the density cos / pi.
#ifndef PHLUX_DIFFUSE_CL
#define PHLUX_DIFFUSE_CL

#include "lobes/lobe.h"

#define DIFFUSE_PARAMETERS(COLOUR, NUMBER) COLOUR(reflectance, 0.5, 0, 1, "fraction of light that is reflected")
LOBE_STRUCT(Diffuse, DIFFUSE)

static inline LobeValue diffuse_evaluate(Diffuse m, Vec3 fixed, Vec3 generated) {
  LobeValue v;
  v.value = vec_scale((Real)(INV_PI), m.reflectance);
  v.density = larger(generated.z, (Real)(0.0f)) * INV_PI;
  v.reverse = larger(fixed.z, (Real)(0.0f)) * INV_PI;
  return v;
}

static inline Vec3 diffuse_reflectivity(Diffuse m, Vec3 fixed) { return m.reflectance; }

static inline LobeSample diffuse_sample(Diffuse m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  LobeSample s;
  s.direction = cosine_direction(uniform_real(random.words.y), uniform_real(random.words.z));
  s.weight = m.reflectance;
  s.density = s.direction.z * INV_PI;
  s.delta = NO_LANES;
  s.draws = (Int)(1);
  return s;
}

#endif
