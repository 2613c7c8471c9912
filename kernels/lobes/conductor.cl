// A smooth conductor: a mirror whose reflectance is specular_reflectance times Fresnel's for the complex index of
// refraction eta + i k. With eta = 0 Fresnel's reflectance is 1, and the host uses the model `mirror` instead.
#ifndef PHLUX_CONDUCTOR_CL
#define PHLUX_CONDUCTOR_CL

#include "lobes/lobe.h"
#include "math/fresnel.h"

#define CONDUCTOR_PARAMETERS(COLOUR, NUMBER)                                                                           \
  COLOUR(eta, 0, 0, 100, "index of refraction relative to the outside, real part")                                     \
  COLOUR(k, 1, 0, 100, "imaginary part of the index of refraction")                                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")
#define CONDUCTOR_HAS_DELTA 1
LOBE_STRUCT(Conductor, CONDUCTOR)

static inline LobeValue conductor_evaluate(Conductor m, Vec3 fixed, Vec3 generated) { return no_lobe_value(); }

static inline Vec3 conductor_reflectivity(Conductor m, Vec3 fixed) {
  return vec_mul(m.specular_reflectance, conductor_reflectances(fixed.z, m.eta, m.k));
}

static inline LobeSample conductor_sample(Conductor m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  return delta_sample(mirrored(fixed), conductor_reflectivity(m, fixed));
}

#endif
