// A thin plate of a dielectric with parallel faces, such as a window pane, which does not refract light that passes.
// Each face reflects the fraction r, and the plate r + (1 - r)^2 r (1 + r^2 + r^4 + ...) = 2 r / (1 + r), by repeated
// reflection between the faces.
#ifndef PHLUX_THINDIELECTRIC_CL
#define PHLUX_THINDIELECTRIC_CL

#include "lobes/lobe.h"
#include "math/fresnel.h"

#define THINDIELECTRIC_PARAMETERS(COLOUR, NUMBER)                                                                      \
  NUMBER(int_ior, 1.5046, 0.1, 10, "index of refraction of the plate")                                                 \
  NUMBER(ext_ior, 1.000277, 0.1, 10, "index of refraction on both sides of it")                                        \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  COLOUR(specular_transmittance, 1, 0, 1, "factor of the transmittance")
#define THINDIELECTRIC_HAS_DELTA 1
#define THINDIELECTRIC_TRANSMITS 1
#define THINDIELECTRIC_INDEX(m) (Real)(1.0f)
LOBE_STRUCT(Thindielectric, THINDIELECTRIC)

static inline LobeValue thindielectric_evaluate(Thindielectric m, Vec3 fixed, Vec3 generated) {
  return no_lobe_value();
}

static inline Real plate_reflectance(Thindielectric m, Vec3 fixed) {
  const Real r = refraction(fixed, m.int_ior / m.ext_ior).reflectance;
  return 2.0f * r / (1.0f + r);
}

static inline Vec3 thindielectric_reflectivity(Thindielectric m, Vec3 fixed) {
  const Real reflected = plate_reflectance(m, fixed);
  return reflected_and_transmitted(reflected, m.specular_reflectance, m.specular_transmittance);
}

static inline LobeSample thindielectric_sample(Thindielectric m, Vec3 fixed, Real choice, RandomDraws random,
                                               Mask active) {
  const DeltaChoice c =
      reflect_or_transmit(plate_reflectance(m, fixed), m.specular_reflectance, m.specular_transmittance, choice);
  return delta_sample(vec_select(c.reflects, mirrored(fixed), vec_scale((Real)(-1.0f), fixed)), c.weight);
}

#endif
