// A rough surface between two dielectrics (Walter et al. 2007): microfacets that reflect and refract. With the relative
// index of refraction I and sigma of microfacets.h, for power as lobe.h requires, f_r on the far side is
//   (1 - F(fixed.h)) D(h) I^2 |fixed.h| |generated.h| / (sigma(fixed) sigma(generated) (fixed.h + I generated.h)^2).
#ifndef PHLUX_ROUGH_DIELECTRIC_H
#define PHLUX_ROUGH_DIELECTRIC_H

#include "lobes/lobe.h"
#include "lobes/microfacets.h"
#include "math/fresnel.h"

typedef struct {
  Facets facets;
  Real index;                      // relative, of the far side
  Vec3 reflectance, transmittance; // their factors
} RoughDielectric;

// The probability of sampling reflection by a facet of Fresnel reflectance F, instead of transmission.
static inline Real reflected_share(RoughDielectric d, Real reflectance) {
  const Real reflected = reflectance * vec_max(d.reflectance);
  const Real all = fma(1.0f - reflectance, vec_max(d.transmittance), reflected);
  return all > 0.0f ? reflected / all : (Real)(1.0f);
}

// Least cosine to a facet that transmits: a smaller cosine, which is a difference of numbers near 1, would have a
// relative rounding error of up to 2^-23 / this, a thousandth.
#define LEAST_FACET_COSINE 1.2e-4f

// The far side: `generated` is below the surface.
static inline LobeValue rough_dielectric_through(RoughDielectric d, Vec3 fixed, Vec3 generated) {
  const Real index = d.index;
  // The normal for which `generated` is the refracted direction, on the side of `fixed`.
  const Vec3 sum = vec_along(fixed, index, generated);
  const Real length2 = larger(vec_dot(sum, sum), (Real)(1e-30f));
  const Vec3 h = vec_scale((index > 1.0f ? (Real)(-1.0f) : (Real)(1.0f)) / sqrt(length2), sum);
  const Real fixed_h = vec_dot(fixed, h), generated_h = -vec_dot(generated, h);
  const Mask possible = (fixed_h > LEAST_FACET_COSINE) & (generated_h > LEAST_FACET_COSINE) & (h.z > 0.0f);
  const Real reflectance = fresnel_reflectance(fixed_h, generated_h, index);
  const Real density = facet_density(d.facets, h);
  const Real by_fixed = projected_area(d.facets, fixed), by_generated = projected_area(d.facets, generated);
  const Real share = 1.0f - reflected_share(d, reflectance);
  LobeValue v;
  const Real value =
      (1.0f - reflectance) * density * index * index * fixed_h * generated_h / (by_fixed * by_generated * length2);
  v.value = vec_scale(possible ? value : (Real)(0.0f), d.transmittance);
  // dh / d(generated) and dh / d(fixed): length2 is (fixed.h + I generated.h)^2.
  const Real forward = share * index * index * generated_h / length2, backward = share * fixed_h / length2;
  v.density = possible ? forward * facet_sample_density(d.facets, density, by_fixed, h, fixed_h) : (Real)(0.0f);
  v.reverse =
      possible ? backward * facet_sample_density(d.facets, density, by_generated, h, generated_h) : (Real)(0.0f);
  return v;
}

static inline LobeValue rough_dielectric_evaluate(RoughDielectric d, Vec3 fixed, Vec3 generated) {
  const FacetReflection r = facet_reflection(d.facets, fixed, generated);
  const Real reflectance = refraction(in_plane(r.cosine), d.index).reflectance;
  const Real share = reflected_share(d, reflectance);
  const LobeValue through = rough_dielectric_through(d, fixed, generated);
  const Mask reflects = generated.z > 0.0f;
  LobeValue v;
  v.value = vec_select(reflects, vec_scale(reflectance * r.value, d.reflectance), through.value);
  v.density = reflects ? share * r.density : through.density;
  v.reverse = reflects ? share * r.reverse : through.reverse;
  return v;
}

// An estimate: the reflectivity if the normals of all microfacets were that of the surface. Beyond the critical angle
// some facets transmit; the estimate includes a part for them, so that their light survives roulette.
static inline Vec3 rough_dielectric_reflectivity(RoughDielectric d, Vec3 fixed) {
  const Real reflected =
      smaller(refraction(fixed, d.index).reflectance, 1.0f - 0.25f * larger(d.facets.alpha, d.facets.alpha_v));
  return reflected_and_transmitted(reflected, d.reflectance, d.transmittance);
}

static inline LobeSample rough_dielectric_sample(RoughDielectric d, Vec3 fixed, Real choice, RandomDraws random) {
  const Real index = d.index;
  const Vec3 h = sample_facet(d.facets, fixed, uniform_real(random.words.y), uniform_real(random.words.z));
  const Real cosine = vec_dot(fixed, h);
  const Vec3 along = vec_along(fixed, -cosine, h); // the component of `fixed` in the plane of the facet
  const Vec3 on_facet = vec3((Real)(0.0f), sqrt(vec_dot(along, along)), cosine);
  const Refraction r = refraction(on_facet, index);
  const Mask reflects = choice < reflected_share(d, r.reflectance);
  const Vec3 through = vec_normalize(vec_along(vec_scale(-1.0f / index, along), -r.cosine, h));
  Vec3 direction = vec_select(reflects, reflected_by_facet(fixed, h), through);
  // No direction if the facet is not visible from `fixed`, or if the reflected direction is below the surface or the
  // refracted one above it.
  const Mask possible = (cosine > 0.0f) & ((direction.z > 0.0f) == reflects);
  direction.z = possible ? direction.z : (Real)(0.0f);
  LobeSample s = lobe_sample(direction, rough_dielectric_evaluate(d, fixed, direction));
  s.weight = vec_select(possible, s.weight, vec_all((Real)(0.0f)));
  return s;
}

#endif
