// A rough conductor: mirrors in all directions of the facets' normals (Torrance and Sparrow 1967),
//   f_r = F(fixed.h) D(h) / (4 sigma(fixed) sigma(generated)).
#ifndef PHLUX_ROUGHCONDUCTOR_CL
#define PHLUX_ROUGHCONDUCTOR_CL

#include "lobes/lobe.h"
#include "lobes/microfacets.h"
#include "math/fresnel.h"

#define ROUGHCONDUCTOR_PARAMETERS(COLOUR, NUMBER)                                                                      \
  COLOUR(eta, 0, 0, 100, "index of refraction relative to the outside, real part")                                     \
  COLOUR(k, 1, 0, 100, "imaginary part of the index of refraction")                                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the reflectance")                                                   \
  NUMBER(alpha, 0.1, 0.001, 1, "roughness: root mean square slope of the facets, times sqrt(2)")                       \
  NUMBER(distribution, 0, 0, 2, "of the facets' normals: 0 beckmann, 1 ggx, 2 phong")
#define ROUGHCONDUCTOR_REFLECTIVITY_IS_ESTIMATE 1
LOBE_STRUCT(Roughconductor, ROUGHCONDUCTOR)

static inline Vec3 roughconductor_fresnel(Roughconductor m, Real cosine) {
  return vec_mul(m.specular_reflectance, conductor_reflectances(cosine, m.eta, m.k));
}

static inline LobeValue roughconductor_evaluate(Roughconductor m, Vec3 fixed, Vec3 generated) {
  const Facets f = facets_of(m.alpha, m.distribution);
  const FacetReflection r = facet_reflection(f, fixed, generated);
  LobeValue v;
  v.value = vec_scale(r.value, roughconductor_fresnel(m, r.cosine));
  v.density = r.density;
  v.reverse = r.reverse;
  return v;
}

// As if all facets were at the angle of the surface.
static inline Vec3 roughconductor_reflectivity(Roughconductor m, Vec3 fixed) { return roughconductor_fresnel(m, fixed.z); }

static inline LobeSample roughconductor_sample(Roughconductor m, Vec3 fixed, Real choice, RandomDraws random,
                                               Mask active) {
  const Facets f = facets_of(m.alpha, m.distribution);
  const Vec3 h = sample_facet(f, fixed, uniform_real(random.words.y), uniform_real(random.words.z));
  const Vec3 direction = reflected_by_facet(fixed, h);
  return lobe_sample(direction, roughconductor_evaluate(m, fixed, direction));
}

#endif
