// Microfacet models (Torrance and Sparrow 1967; Walter et al. 2007): distributions of the normals h of microfacets, and
// Smith's masking, for one roughness alpha in all directions, or two along x and y of the frame. alpha = 0 is a smooth
// surface. Beckmann's alpha is sqrt(2) times the root mean square slope in one direction; that of GGX is infinite.
// Beckmann and GGX surfaces with any alpha are stretched surfaces with alpha = 1: slopes are divided by alpha.
//
// The density of visible normals (Heitz 2014) is D(h) (v.h)+ / sigma(v), where sigma(v) = cos / G1(v) is the projected
// area of the facets visible from v, per area of the surface. With sigma instead of G1 no formula divides by a cosine.
// Slopes are computed from x and y of h, because 1 - cos^2 has no correct digit for a slope of 1e-3.
#ifndef PHLUX_MICROFACETS_H
#define PHLUX_MICROFACETS_H

#include "math/directions.h"
#include "math/random.h"
#include "phong/reflectivity.h"

// Values of the parameter `distribution` of a model.
#define FACETS_BECKMANN 0
#define FACETS_GGX 1
#define FACETS_PHONG 2

typedef struct {
  Real alpha, alpha_v; // along x and y
  int anisotropic;     // 0: both are equal
  Mask ggx, phong;     // neither: Beckmann
} Facets;

static inline Facets facets_of(Real alpha, Real distribution) {
  Facets f;
  f.alpha = f.alpha_v = alpha;
  f.anisotropic = 0;
  f.ggx = distribution == (Real)(FACETS_GGX);
  f.phong = distribution == (Real)(FACETS_PHONG);
  return f;
}

// Not for Phong's distribution.
static inline Facets anisotropic_facets(Real alpha_u, Real alpha_v, Real distribution) {
  Facets f;
  f.alpha = alpha_u;
  f.alpha_v = alpha_v;
  f.anisotropic = 1;
  f.ggx = distribution == (Real)(FACETS_GGX);
  f.phong = NO_LANES;
  return f;
}

// The exponent of Phong's distribution that resembles Beckmann's with this alpha (Walter et al. 2007, equation 40).
static inline Real facet_exponent(Real alpha) { return 2.0f / (alpha * alpha) - 2.0f; }

// D(h) for two roughnesses: the stretched slope is sqrt(slope2 / cosine2).
static inline Real anisotropic_density(Facets f, Vec3 h, Real cosine2) {
  const Real u = h.x / f.alpha, v = h.y / f.alpha_v;
  const Real slope2 = fma(u, u, v * v), scale = INV_PI / (f.alpha * f.alpha_v);
  const Real ellipsoid = cosine2 + slope2;
  const Real ggx = scale / (ellipsoid * ellipsoid);
  if (all_lanes(f.ggx)) return ggx;
  const Real beckmann = scale * exp(-slope2 / cosine2) / (cosine2 * cosine2);
  return f.ggx ? ggx : beckmann;
}

// D(h), per solid angle, for h.z > 0. The integral of D(h) h.z is 1.
static inline Real facet_density(Facets f, Vec3 h) {
  const Real sine2 = fma(h.x, h.x, h.y * h.y), cosine2 = larger(1.0f - sine2, (Real)(1e-9f));
  if (f.anisotropic) return anisotropic_density(f, h, cosine2);
  const Real alpha2 = f.alpha * f.alpha, ellipsoid = fma(alpha2, cosine2, sine2);
  const Real ggx = alpha2 * INV_PI / (ellipsoid * ellipsoid);
  if (all_lanes(f.ggx)) return ggx;
  const Real beckmann = INV_PI * exp(-sine2 / (alpha2 * cosine2)) / (alpha2 * cosine2 * cosine2);
  const Real exponent = facet_exponent(f.alpha);
  const Real phong =
      (exponent + 2.0f) * (0.5f * INV_PI) * exp(0.5f * exponent * log1p(-smaller(sine2, (Real)(ONE_MINUS_EPSILON))));
  return f.ggx ? ggx : f.phong ? phong : beckmann;
}

// sigma(v): for GGX by Heitz 2014, equation 72, for Beckmann by his equation 65. For Phong it is an integral of the
// same form as the reflectivity of the modified Phong lobe. (Walter et al. 2007 approximate it by Beckmann's masking,
// and with alpha = 1 reflect a third more light than arrives.)
static inline Real projected_area(Facets f, Vec3 v) {
  const Real cosine = fabs(v.z), sine = sqrt(fma(v.x, v.x, v.y * v.y));
  Real spread = f.alpha * sine;
  if (f.anisotropic) {
    const Real u = f.alpha * v.x, w = f.alpha_v * v.y;
    spread = sqrt(fma(u, u, w * w));
  }
  const Real ggx = 0.5f * (cosine + sqrt(fma(cosine, cosine, spread * spread)));
  if (all_lanes(f.ggx)) return ggx;
  const Real a = cosine / larger(spread, (Real)(1e-20f));
  const Real tail = spread * (0.28209479f * exp(-a * a)) - 0.5f * cosine * erfc(a); // cos Lambda; 1 / (2 sqrt(pi))
  const Real beckmann = cosine + larger(tail, (Real)(0.0f));
  const Real phong = phong_reflectivity_of(facet_exponent(f.alpha), smaller(cosine, (Real)(ONE_MINUS_EPSILON)));
  return f.ggx ? ggx : f.phong ? phong : beckmann;
}

// The density of h by sample_facet for `fixed`, per solid angle of h: that of visible normals, or for Phong of all
// normals. `density` is D(h), `projected` is sigma(fixed).
static inline Real facet_sample_density(Facets f, Real density, Real projected, Vec3 h, Real fixed_h) {
  return density * (f.phong ? larger(h.z, (Real)(0.0f)) : fixed_h / projected);
}

// Samples visible normals of GGX (Heitz 2018): those of a hemisphere, after the surface is stretched by 1 / alpha.
static inline Vec3 sample_ggx_facet(Facets f, Vec3 fixed, Real u1, Real u2) {
  const Vec3 v = vec_normalize(vec3(f.alpha * fixed.x, f.alpha_v * fixed.y, fixed.z));
  const Real length2 = fma(v.x, v.x, v.y * v.y);
  const Mask tilted = length2 > 0.0f;
  const Real inverse = 1.0f / sqrt(tilted ? length2 : (Real)(1.0f));
  const Vec3 t1 = vec3(tilted ? -v.y * inverse : (Real)(1.0f), tilted ? v.x * inverse : (Real)(0.0f), (Real)(0.0f));
  const Vec3 t2 = vec_cross(v, t1);
  Real cos_phi, sin_phi;
  cos_sin_turns(u2, &cos_phi, &sin_phi);
  const Real r = sqrt(u1), s = 0.5f * (1.0f + v.z), p1 = r * cos_phi;
  const Real p2 = fma(s, r * sin_phi, (1.0f - s) * sqrt(larger(fma(-p1, p1, (Real)(1.0f)), (Real)(0.0f))));
  const Real p3 = sqrt(larger(fma(-p2, p2, fma(-p1, p1, (Real)(1.0f))), (Real)(0.0f)));
  const Vec3 n = vec_along(vec_along(vec_scale(p3, v), p1, t1), p2, t2);
  return vec_normalize(vec3(f.alpha * n.x, f.alpha_v * n.y, larger(n.z, (Real)(1e-7f))));
}

// The inverse of the error function, with a relative error of 3e-7 (Giles 2012).
static inline Real inverse_erf(Real x) {
  const Real w = -log((1.0f - x) * (1.0f + x));
  const Real a = w - 2.5f, b = sqrt(w) - 3.0f;
  Real p = (Real)(2.81022636e-08f), q = (Real)(-2.00214257e-04f);
  p = fma(p, a, (Real)(3.43273939e-07f));
  p = fma(p, a, (Real)(-3.5233877e-06f));
  p = fma(p, a, (Real)(-4.39150654e-06f));
  p = fma(p, a, (Real)(2.1858087e-04f));
  p = fma(p, a, (Real)(-1.25372503e-03f));
  p = fma(p, a, (Real)(-4.17768164e-03f));
  p = fma(p, a, (Real)(2.46640727e-01f));
  p = fma(p, a, (Real)(1.50140941f));
  q = fma(q, b, (Real)(1.00950558e-04f));
  q = fma(q, b, (Real)(1.34934322e-03f));
  q = fma(q, b, (Real)(-3.67342844e-03f));
  q = fma(q, b, (Real)(5.73950773e-03f));
  q = fma(q, b, (Real)(-7.6224613e-03f));
  q = fma(q, b, (Real)(9.43887047e-03f));
  q = fma(q, b, (Real)(1.00167406f));
  q = fma(q, b, (Real)(2.83297682f));
  return (w < 5.0f ? p : q) * x;
}

// Samples visible normals of Beckmann's distribution (Heitz and d'Eon 2014). The surface is stretched to alpha = 1,
// where slopes are normally distributed. The slope perpendicular to `fixed` is independent of it. The slope x along
// `fixed` has the density (cos - x sin)+ exp(-x^2), whose distribution function is inverted by Newton's method within a
// bracket.
static inline Vec3 sample_beckmann_facet(Facets f, Vec3 fixed, Real u1, Real u2) {
  const Vec3 v = vec_normalize(vec3(f.alpha * fixed.x, f.alpha_v * fixed.y, fixed.z));
  const Real sine = sqrt(fma(v.x, v.x, v.y * v.y));
  const Real tail = 0.28209479f * sine, half_cosine = 0.5f * v.z; // 1 / (2 sqrt(pi))
  Real low = (Real)(-5.0f), high = sine * 5.0f > v.z ? v.z / sine : (Real)(5.0f);
  const Real wanted = u1 * fma(half_cosine, erfc(-high), tail * exp(-high * high));
  Real x = smaller((Real)(0.0f), 0.5f * (low + high));
  for (int i = 0; i < 12; ++i) {
    const Real gauss = exp(-x * x);
    const Real excess = fma(half_cosine, erfc(-x), tail * gauss) - wanted;
    const Mask above = excess > 0.0f;
    high = above ? x : high;
    low = above ? low : x;
    const Real next = x - excess / ((v.z - x * sine) * (gauss * 0.56418958f)); // 1 / sqrt(pi)
    x = ((next >= low) & (next <= high)) ? next : 0.5f * (low + high);
  }
  const Real y = inverse_erf(2.0f * u2 - 1.0f);
  const Mask tilted = sine > 0.0f;
  const Real p = tilted ? v.x / sine : (Real)(1.0f), q = tilted ? v.y / sine : (Real)(0.0f);
  return vec_normalize(vec3(-f.alpha * fma(p, x, -q * y), -f.alpha_v * fma(q, x, p * y), (Real)(1.0f)));
}

// Samples a normal with the density facet_sample_density for `fixed`.
static inline Vec3 sample_facet(Facets f, Vec3 fixed, Real u1, Real u2) {
  if (all_lanes(f.ggx)) return sample_ggx_facet(f, fixed, u1, u2);
  if (all_lanes(f.phong)) return cosine_power_direction(facet_exponent(f.alpha) + 1.0f, u1, u2);
  const Vec3 visible = vec_select(f.ggx, sample_ggx_facet(f, fixed, u1, u2), sample_beckmann_facet(f, fixed, u1, u2));
  if (f.anisotropic) return visible;
  return vec_select(f.phong, cosine_power_direction(facet_exponent(f.alpha) + 1.0f, u1, u2), visible);
}

// ---- Reflection

// The mirror image of `fixed` about h; z = -1 if the facet is not visible from `fixed`.
static inline Vec3 reflected_by_facet(Vec3 fixed, Vec3 h) {
  const Real cosine = vec_dot(fixed, h);
  const Vec3 d = vec_along(vec_scale((Real)(-1.0f), fixed), 2.0f * cosine, h);
  return vec3(d.x, d.y, cosine > 0.0f ? d.z : (Real)(-1.0f));
}

typedef struct {
  Real cosine;           // fixed.h
  Real value;            // D(h) / (4 sigma(fixed) sigma(generated)), 1 / sr
  Real density, reverse; // as in LobeValue, if all facets reflect
} FacetReflection;

static inline FacetReflection facet_reflection(Facets f, Vec3 fixed, Vec3 generated) {
  const Vec3 sum = vec_add(fixed, generated);
  const Real length2 = vec_dot(sum, sum), length = sqrt(larger(length2, (Real)(1e-30f)));
  const Vec3 h = vec_scale(1.0f / length, sum);
  const Real density = facet_density(f, h);
  const Real by_fixed = projected_area(f, fixed), by_generated = projected_area(f, generated);
  FacetReflection r;
  r.cosine = 0.5f * length;               // fixed.h = generated.h, computed symmetrically
  const Real jacobian = 0.25f / r.cosine; // dh / d(generated)
  r.value = 0.25f * density / (by_fixed * by_generated);
  r.density = jacobian * facet_sample_density(f, density, by_fixed, h, r.cosine);
  r.reverse = jacobian * facet_sample_density(f, density, by_generated, h, r.cosine);
  return r;
}

#endif
