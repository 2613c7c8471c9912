// A rough conductor with the same roughness in all directions.
#ifndef PHLUX_ROUGHCONDUCTOR_CL
#define PHLUX_ROUGHCONDUCTOR_CL

#include "lobes/rough_conductor.h"

#define ROUGHCONDUCTOR_PARAMETERS(COLOUR, NUMBER)                                                                      \
  COLOUR(eta, 0, 0, 100, "index of refraction relative to the outside, real part")                                     \
  COLOUR(k, 1, 0, 100, "imaginary part of the index of refraction")                                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  NUMBER(alpha, 0.1, 0.001, 1, "roughness; beckmann: sqrt(2) times the rms slope of the facets in one direction")      \
  NUMBER(distribution, 0, 0, 2, "of the facets' normals: 0 beckmann, 1 ggx, 2 phong")
#define ROUGHCONDUCTOR_REFLECTIVITY_IS_ESTIMATE 1
LOBE_STRUCT(Roughconductor, ROUGHCONDUCTOR)

static inline RoughConductor roughconductor_surface(Roughconductor m) {
  RoughConductor c;
  c.facets = facets_of(m.alpha, m.distribution);
  c.eta = m.eta;
  c.k = m.k;
  c.factor = m.specular_reflectance;
  return c;
}

static inline LobeValue roughconductor_evaluate(Roughconductor m, Vec3 fixed, Vec3 generated) {
  return rough_conductor_evaluate(roughconductor_surface(m), fixed, generated);
}

// An estimate: the reflectivity if the normals of all microfacets were that of the surface.
static inline Vec3 roughconductor_reflectivity(Roughconductor m, Vec3 fixed) {
  return rough_conductor_fresnel(roughconductor_surface(m), fixed.z);
}

static inline LobeSample roughconductor_sample(Roughconductor m, Vec3 fixed, Real choice, RandomDraws random,
                                               Mask active) {
  return rough_conductor_sample(roughconductor_surface(m), fixed, random);
}

#endif
