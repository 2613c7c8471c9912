// A rough surface between two dielectrics with the same roughness in all directions.
#ifndef PHLUX_ROUGHDIELECTRIC_CL
#define PHLUX_ROUGHDIELECTRIC_CL

#include "lobes/rough_dielectric.h"

#define ROUGHDIELECTRIC_PARAMETERS(COLOUR, NUMBER)                                                                     \
  NUMBER(int_ior, 1.5046, 0.1, 10, "index of refraction behind the surface")                                           \
  NUMBER(ext_ior, 1.000277, 0.1, 10, "index of refraction in front of the surface")                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  COLOUR(specular_transmittance, 1, 0, 1, "factor of the transmittance")                                               \
  NUMBER(alpha, 0.1, 0.001, 1, "roughness; beckmann: sqrt(2) times the rms slope of the facets in one direction")      \
  NUMBER(distribution, 0, 0, 2, "of the facets' normals: 0 beckmann, 1 ggx, 2 phong")
#define ROUGHDIELECTRIC_TRANSMITS 1
#define ROUGHDIELECTRIC_INDEX(m) relative_index((m).front, (m).int_ior, (m).ext_ior)
#define ROUGHDIELECTRIC_REFLECTIVITY_IS_ESTIMATE 1
LOBE_STRUCT(Roughdielectric, ROUGHDIELECTRIC)

static inline RoughDielectric roughdielectric_surface(Roughdielectric m) {
  RoughDielectric d;
  d.facets = facets_of(m.alpha, m.distribution);
  d.index = ROUGHDIELECTRIC_INDEX(m);
  d.reflectance = m.specular_reflectance;
  d.transmittance = m.specular_transmittance;
  return d;
}

static inline LobeValue roughdielectric_evaluate(Roughdielectric m, Vec3 fixed, Vec3 generated) {
  return rough_dielectric_evaluate(roughdielectric_surface(m), fixed, generated);
}

static inline Vec3 roughdielectric_reflectivity(Roughdielectric m, Vec3 fixed) {
  return rough_dielectric_reflectivity(roughdielectric_surface(m), fixed);
}

static inline LobeSample roughdielectric_sample(Roughdielectric m, Vec3 fixed, Real choice, RandomDraws random,
                                                Mask active) {
  return rough_dielectric_sample(roughdielectric_surface(m), fixed, choice, random);
}

#endif
