// The smooth surface between two dielectrics, such as glass in air: a mirror direction and, except at total internal
// reflection, a refracted one. They are chosen in proportion to F and 1 - F times their factors, F being Fresnel's
// reflectance.
#ifndef PHLUX_DIELECTRIC_CL
#define PHLUX_DIELECTRIC_CL

#include "lobes/lobe.h"
#include "math/fresnel.h"

#define DIELECTRIC_PARAMETERS(COLOUR, NUMBER)                                                                          \
  NUMBER(int_ior, 1.5046, 0.1, 10, "index of refraction behind the surface")                                           \
  NUMBER(ext_ior, 1.000277, 0.1, 10, "index of refraction in front of the surface")                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  COLOUR(specular_transmittance, 1, 0, 1, "factor of the transmittance")
#define DIELECTRIC_HAS_DELTA 1
#define DIELECTRIC_TRANSMITS 1
#define DIELECTRIC_INDEX(m) relative_index((m).front, (m).int_ior, (m).ext_ior)
LOBE_STRUCT(Dielectric, DIELECTRIC)

static inline LobeValue dielectric_evaluate(Dielectric m, Vec3 fixed, Vec3 generated) { return no_lobe_value(); }

static inline Vec3 dielectric_reflectivity(Dielectric m, Vec3 fixed) {
  const Real reflected = refraction(fixed, DIELECTRIC_INDEX(m)).reflectance;
  return reflected_and_transmitted(reflected, m.specular_reflectance, m.specular_transmittance);
}

static inline LobeSample dielectric_sample(Dielectric m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Real index = DIELECTRIC_INDEX(m);
  const Refraction r = refraction(fixed, index);
  const DeltaChoice c = reflect_or_transmit(r.reflectance, m.specular_reflectance, m.specular_transmittance, choice);
  return delta_sample(vec_select(c.reflects, mirrored(fixed), refracted(fixed, index, r)), c.weight);
}

#endif
