// A mirror: f_r is a delta distribution at the mirror direction, times specular_reflectance / cos.
#ifndef PHLUX_MIRROR_CL
#define PHLUX_MIRROR_CL

#include "lobes/lobe.h"
#include "math/fresnel.h"

#define MIRROR_PARAMETERS(COLOUR, NUMBER)                                                                              \
  COLOUR(specular_reflectance, 1, 0, 1, "fraction of light that is reflected in the mirror direction")
#define MIRROR_HAS_DELTA 1
LOBE_STRUCT(Mirror, MIRROR)

static inline LobeValue mirror_evaluate(Mirror m, Vec3 fixed, Vec3 generated) { return no_lobe_value(); }

static inline Vec3 mirror_reflectivity(Mirror m, Vec3 fixed) { return m.specular_reflectance; }

static inline LobeSample mirror_sample(Mirror m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  return delta_sample(mirrored(fixed), m.specular_reflectance);
}

#endif
