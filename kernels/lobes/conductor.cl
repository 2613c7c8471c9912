// A smooth conductor: a mirror. f_r is a delta distribution at the mirror direction, times specular_reflectance / cos.
#ifndef PHLUX_CONDUCTOR_CL
#define PHLUX_CONDUCTOR_CL

#include "lobes/lobe.h"

#define CONDUCTOR_PARAMETERS(COLOUR, NUMBER)                                                                           \
  COLOUR(specular_reflectance, 1, 0, 1, "fraction of light that is reflected in the mirror direction")
#define CONDUCTOR_HAS_DELTA 1
LOBE_STRUCT(Conductor, CONDUCTOR)

static inline LobeValue conductor_evaluate(Conductor m, Vec3 fixed, Vec3 generated) {
  LobeValue v;
  v.value = vec_all((Real)(0.0f));
  v.density = v.reverse = (Real)(0.0f);
  return v;
}

static inline Vec3 conductor_reflectivity(Conductor m, Vec3 fixed) { return m.specular_reflectance; }

static inline LobeSample conductor_sample(Conductor m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  LobeSample s;
  s.direction = vec3(-fixed.x, -fixed.y, fixed.z);
  s.weight = m.specular_reflectance;
  s.density = (Real)(1.0f);
  s.delta = ALL_LANES;
  s.draws = (Int)(1);
  return s;
}

#endif
