// A rough conductor: microfacets that are smooth conductors (Torrance and Sparrow 1967),
//   f_r = F(fixed.h) D(h) / (4 sigma(fixed) sigma(generated)).
#ifndef PHLUX_ROUGH_CONDUCTOR_H
#define PHLUX_ROUGH_CONDUCTOR_H

#include "lobes/lobe.h"
#include "lobes/microfacets.h"
#include "math/fresnel.h"

typedef struct {
  Facets facets;
  Vec3 eta, k, factor; // factor of the reflectance
} RoughConductor;

static inline Vec3 rough_conductor_fresnel(RoughConductor c, Real cosine) {
  return vec_mul(c.factor, conductor_reflectances(cosine, c.eta, c.k));
}

static inline LobeValue rough_conductor_evaluate(RoughConductor c, Vec3 fixed, Vec3 generated) {
  const FacetReflection r = facet_reflection(c.facets, fixed, generated);
  LobeValue v;
  v.value = vec_scale(r.value, rough_conductor_fresnel(c, r.cosine));
  v.density = r.density;
  v.reverse = r.reverse;
  return v;
}

static inline LobeSample rough_conductor_sample(RoughConductor c, Vec3 fixed, RandomDraws random) {
  const Vec3 h = sample_facet(c.facets, fixed, uniform_real(random.words.y), uniform_real(random.words.z));
  const Vec3 direction = reflected_by_facet(fixed, h);
  return lobe_sample(direction, rough_conductor_evaluate(c, fixed, direction));
}

#endif
