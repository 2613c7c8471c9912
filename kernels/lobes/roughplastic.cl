// Rough plastic: as plastic, under a surface of microfacets. T is the fraction of the light that the surface transmits,
// which the host integrates over the facets. Of the light from the base the surface reflects the fraction d
// (`internal`): all that is not transmitted, or if `lossy` only what a single facet reflects.
//   f_r = F(fixed.h) D(h) / (4 sigma(fixed) sigma(generated)) + b T(fixed) T(generated) / (pi I^2).
#ifndef PHLUX_ROUGHPLASTIC_CL
#define PHLUX_ROUGHPLASTIC_CL

#include "lobes/coated_base.h"
#include "lobes/lobe.h"
#include "lobes/microfacets.h"
#include "math/fresnel.h"

#define ROUGHPLASTIC_PARAMETERS(COLOUR, NUMBER)                                                                        \
  NUMBER(int_ior, 1.49, 0.1, 10, "index of refraction of the surface")                                                 \
  NUMBER(ext_ior, 1.000277, 0.1, 10, "index of refraction in front of it")                                             \
  COLOUR(diffuse_reflectance, 0.5, 0, 1, "reflectance of the base")                                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the surface's reflectance")                                         \
  NUMBER(nonlinear, 0, 0, 1, "1: the light between base and surface shifts in colour")                                 \
  NUMBER(alpha, 0.1, 0.001, 1, "roughness; beckmann: sqrt(2) times the rms slope of the facets in one direction")      \
  NUMBER(distribution, 0, 0, 2, "of the facets' normals: 0 beckmann, 1 ggx, 2 phong")                                  \
  NUMBER(lossy, 0, 0, 1, "1: light inside that a second facet blocks is lost, as in Mitsuba 3")
// The table has T at ROUGHPLASTIC_INTERVALS + 1 cosines, evenly spaced from 0 to 1, from index table_row on.
#define ROUGHPLASTIC_DERIVED(NUMBER, INDEX) NUMBER(internal) INDEX(table_row)
#define ROUGHPLASTIC_INTERVALS 128
#define ROUGHPLASTIC_REFLECTIVITY_IS_ESTIMATE 1
LOBE_STRUCT(Roughplastic, ROUGHPLASTIC)

static inline Real surface_transmittance(Roughplastic m, Real cosine) {
  const Real position = fabs(cosine) * (float)ROUGHPLASTIC_INTERVALS;
  const Real below = smaller(floor(position), (Real)(ROUGHPLASTIC_INTERVALS - 1));
  const Int index = m.table_row + to_int(below);
  const Real v0 = gather_real(m.tables, index), v1 = gather_real(m.tables, index + 1);
  return fma(position - below, v1 - v0, v0);
}

// The probability of sampling the surface instead of the base, if the surface transmits the fraction `passing`.
static inline Real roughplastic_share(Roughplastic m, Vec3 base, Real passing) {
  return part_of((1.0f - passing) * vec_max(m.specular_reflectance), passing * (1.0f - m.internal) * vec_max(base));
}

static inline LobeValue roughplastic_evaluate(Roughplastic m, Vec3 fixed, Vec3 generated) {
  const Facets f = facets_of(m.alpha, m.distribution);
  const FacetReflection r = facet_reflection(f, fixed, generated);
  const Real fresnel = refraction(in_plane(r.cosine), m.int_ior / m.ext_ior).reflectance;
  const Vec3 base = coated_base(m.diffuse_reflectance, m.internal, m.nonlinear);
  const Real by_fixed = surface_transmittance(m, fixed.z), by_generated = surface_transmittance(m, generated.z);
  const Real outside_over_inside = m.ext_ior / m.int_ior;
  const Real from_fixed = roughplastic_share(m, base, by_fixed),
             from_generated = roughplastic_share(m, base, by_generated);
  LobeValue v;
  v.value = vec_along(vec_scale(fresnel * r.value, m.specular_reflectance),
                      INV_PI * outside_over_inside * outside_over_inside * by_fixed * by_generated, base);
  v.density = fma(from_fixed, r.density, (1.0f - from_fixed) * larger(generated.z, (Real)(0.0f)) * INV_PI);
  v.reverse = fma(from_generated, r.reverse, (1.0f - from_generated) * larger(fixed.z, (Real)(0.0f)) * INV_PI);
  return v;
}

// An estimate: as if the surface reflected all light that it does not transmit.
static inline Vec3 roughplastic_reflectivity(Roughplastic m, Vec3 fixed) {
  const Real passing = surface_transmittance(m, fixed.z);
  return vec_along(vec_scale(1.0f - passing, m.specular_reflectance), passing * (1.0f - m.internal),
                   coated_base(m.diffuse_reflectance, m.internal, m.nonlinear));
}

static inline LobeSample roughplastic_sample(Roughplastic m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Vec3 base = coated_base(m.diffuse_reflectance, m.internal, m.nonlinear);
  const Mask by_surface = choice < roughplastic_share(m, base, surface_transmittance(m, fixed.z));
  const Real u1 = uniform_real(random.words.y), u2 = uniform_real(random.words.z);
  const Vec3 h = sample_facet(facets_of(m.alpha, m.distribution), fixed, u1, u2);
  const Vec3 direction = vec_select(by_surface, reflected_by_facet(fixed, h), cosine_direction(u1, u2));
  return lobe_sample(direction, roughplastic_evaluate(m, fixed, direction));
}

#endif
