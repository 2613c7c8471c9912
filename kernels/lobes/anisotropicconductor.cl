// A rough conductor with different roughnesses along the two tangents, such as brushed metal.
#ifndef PHLUX_ANISOTROPICCONDUCTOR_CL
#define PHLUX_ANISOTROPICCONDUCTOR_CL

#include "lobes/rough_conductor.h"

#define ANISOTROPICCONDUCTOR_PARAMETERS(COLOUR, NUMBER)                                                                \
  COLOUR(eta, 0, 0, 100, "index of refraction relative to the outside, real part")                                     \
  COLOUR(k, 1, 0, 100, "imaginary part of the index of refraction")                                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  NUMBER(alpha_u, 0.02, 0.005, 1, "roughness along the first tangent; beckmann: sqrt(2) times the rms slope")          \
  NUMBER(alpha_v, 0.02, 0.005, 1, "roughness along the second tangent")                                                \
  NUMBER(distribution, 0, 0, 1, "of the facets' normals: 0 beckmann, 1 ggx")
#define ANISOTROPICCONDUCTOR_NEEDS_TANGENTS 1
#define ANISOTROPICCONDUCTOR_REFLECTIVITY_IS_ESTIMATE 1
LOBE_STRUCT(Anisotropicconductor, ANISOTROPICCONDUCTOR)

static inline RoughConductor anisotropicconductor_surface(Anisotropicconductor m) {
  RoughConductor c;
  c.facets = anisotropic_facets(m.alpha_u, m.alpha_v, m.distribution);
  c.eta = m.eta;
  c.k = m.k;
  c.factor = m.specular_reflectance;
  return c;
}

static inline LobeValue anisotropicconductor_evaluate(Anisotropicconductor m, Vec3 fixed, Vec3 generated) {
  return rough_conductor_evaluate(anisotropicconductor_surface(m), fixed, generated);
}

// An estimate: the reflectivity if the normals of all microfacets were that of the surface.
static inline Vec3 anisotropicconductor_reflectivity(Anisotropicconductor m, Vec3 fixed) {
  return rough_conductor_fresnel(anisotropicconductor_surface(m), fixed.z);
}

static inline LobeSample anisotropicconductor_sample(Anisotropicconductor m, Vec3 fixed, Real choice,
                                                     RandomDraws random, Mask active) {
  return rough_conductor_sample(anisotropicconductor_surface(m), fixed, random);
}

#endif
