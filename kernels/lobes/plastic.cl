// Smooth plastic: a diffuse base of reflectance r under a smooth dielectric surface. The surface reflects the fraction
// F of the light and transmits the rest to the base; of the light from the base it reflects the fraction d (`internal`)
// back:
//   f_r = b (1 - F(fixed)) (1 - F(generated)) / (pi I^2), b = r / (1 - r d) with `nonlinear`, else r / (1 - d),
// in addition to the delta distribution of the surface. With `nonlinear` the base absorbs light at every reflection,
// which shifts colours; without it only at the first.
#ifndef PHLUX_PLASTIC_CL
#define PHLUX_PLASTIC_CL

#include "lobes/coated_base.h"
#include "lobes/lobe.h"
#include "math/fresnel.h"

#define PLASTIC_PARAMETERS(COLOUR, NUMBER)                                                                             \
  NUMBER(int_ior, 1.49, 0.1, 10, "index of refraction of the surface")                                                 \
  NUMBER(ext_ior, 1.000277, 0.1, 10, "index of refraction in front of it")                                             \
  COLOUR(diffuse_reflectance, 0.5, 0, 1, "reflectance of the base")                                                    \
  COLOUR(specular_reflectance, 1, 0, 1, "factor of the surface's reflectance")                                         \
  NUMBER(nonlinear, 0, 0, 1, "1: the light between base and surface shifts in colour")
#define PLASTIC_DERIVED(NUMBER, INDEX) NUMBER(internal)
#define PLASTIC_HAS_DELTA 1
LOBE_STRUCT(Plastic, PLASTIC)

static inline Real plastic_fresnel(Plastic m, Real cosine) {
  return refraction(in_plane(cosine), m.int_ior / m.ext_ior).reflectance;
}

// The probability of sampling the surface instead of the base.
static inline Real plastic_share(Plastic m, Vec3 base, Real fresnel) {
  return part_of(fresnel * vec_max(m.specular_reflectance), (1.0f - fresnel) * (1.0f - m.internal) * vec_max(base));
}

static inline LobeValue plastic_evaluate(Plastic m, Vec3 fixed, Vec3 generated) {
  const Vec3 base = coated_base(m.diffuse_reflectance, m.internal, m.nonlinear);
  const Real by_fixed = plastic_fresnel(m, fabs(fixed.z)), by_generated = plastic_fresnel(m, fabs(generated.z));
  const Real outside_over_inside = m.ext_ior / m.int_ior;
  LobeValue v;
  v.value =
      vec_scale(INV_PI * outside_over_inside * outside_over_inside * (1.0f - by_fixed) * (1.0f - by_generated), base);
  v.density = (1.0f - plastic_share(m, base, by_fixed)) * larger(generated.z, (Real)(0.0f)) * INV_PI;
  v.reverse = (1.0f - plastic_share(m, base, by_generated)) * larger(fixed.z, (Real)(0.0f)) * INV_PI;
  return v;
}

// The integral of (1 - F) cos / (pi I^2) is 1 - d.
static inline Vec3 plastic_reflectivity(Plastic m, Vec3 fixed) {
  const Real fresnel = plastic_fresnel(m, fixed.z);
  return vec_along(vec_scale(fresnel, m.specular_reflectance), (1.0f - fresnel) * (1.0f - m.internal),
                   coated_base(m.diffuse_reflectance, m.internal, m.nonlinear));
}

static inline LobeSample plastic_sample(Plastic m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Real fresnel = plastic_fresnel(m, fixed.z);
  const Real share = plastic_share(m, coated_base(m.diffuse_reflectance, m.internal, m.nonlinear), fresnel);
  const Mask by_surface = choice < share;
  const Vec3 diffuse = cosine_direction(uniform_real(random.words.y), uniform_real(random.words.z));
  LobeSample s = lobe_sample(vec_select(by_surface, mirrored(fixed), diffuse), plastic_evaluate(m, fixed, diffuse));
  s.weight = vec_select(by_surface, vec_scale(fresnel / share, m.specular_reflectance), s.weight);
  s.density = by_surface ? (Real)(1.0f) : s.density;
  s.delta = by_surface;
  return s;
}

#endif
