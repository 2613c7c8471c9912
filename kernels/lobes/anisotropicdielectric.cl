// A rough surface between two dielectrics with different roughnesses along the two tangents.
#ifndef PHLUX_ANISOTROPICDIELECTRIC_CL
#define PHLUX_ANISOTROPICDIELECTRIC_CL

#include "lobes/rough_dielectric.h"

#define ANISOTROPICDIELECTRIC_PARAMETERS(COLOUR, NUMBER)                                                               \
  NUMBER(int_ior, 1.5046, 0.1, 10, "index of refraction behind the surface")                                           \
  NUMBER(ext_ior, 1.000277, 0.1, 10, "index of refraction in front of the surface")                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  COLOUR(specular_transmittance, 1, 0, 1, "factor of the transmittance")                                               \
  NUMBER(alpha_u, 0.02, 0.005, 1, "roughness along the first tangent; beckmann: sqrt(2) times the rms slope")          \
  NUMBER(alpha_v, 0.02, 0.005, 1, "roughness along the second tangent")                                                \
  NUMBER(distribution, 0, 0, 1, "of the facets' normals: 0 beckmann, 1 ggx")
#define ANISOTROPICDIELECTRIC_TRANSMITS 1
#define ANISOTROPICDIELECTRIC_INDEX(m) relative_index((m).front, (m).int_ior, (m).ext_ior)
#define ANISOTROPICDIELECTRIC_NEEDS_TANGENTS 1
#define ANISOTROPICDIELECTRIC_REFLECTIVITY_IS_ESTIMATE 1
LOBE_STRUCT(Anisotropicdielectric, ANISOTROPICDIELECTRIC)

static inline RoughDielectric anisotropicdielectric_surface(Anisotropicdielectric m) {
  RoughDielectric d;
  d.facets = anisotropic_facets(m.alpha_u, m.alpha_v, m.distribution);
  d.index = ANISOTROPICDIELECTRIC_INDEX(m);
  d.reflectance = m.specular_reflectance;
  d.transmittance = m.specular_transmittance;
  return d;
}

static inline LobeValue anisotropicdielectric_evaluate(Anisotropicdielectric m, Vec3 fixed, Vec3 generated) {
  return rough_dielectric_evaluate(anisotropicdielectric_surface(m), fixed, generated);
}

static inline Vec3 anisotropicdielectric_reflectivity(Anisotropicdielectric m, Vec3 fixed) {
  return rough_dielectric_reflectivity(anisotropicdielectric_surface(m), fixed);
}

static inline LobeSample anisotropicdielectric_sample(Anisotropicdielectric m, Vec3 fixed, Real choice,
                                                      RandomDraws random, Mask active) {
  return rough_dielectric_sample(anisotropicdielectric_surface(m), fixed, choice, random);
}

#endif
