// A diffuse base under a dielectric surface, as in plastic.
#ifndef PHLUX_COATED_BASE_H
#define PHLUX_COATED_BASE_H

#include "math/vectors.h"

// Fraction of the light arriving at the base that leaves it, if the surface reflects the fraction d = `internal` back
// to the base each time: r (1 + r d + (r d)^2 + ...) if `nonlinear` is 1; r (1 + d + d^2 + ...) if it is 0.
static inline Vec3 coated_base(Vec3 reflectance, Real internal, Real nonlinear) {
  const Mask shifts = nonlinear > 0.5f;
  const Real one_less = 1.0f - internal;
  return vec3(reflectance.x / (shifts ? fma(-internal, reflectance.x, (Real)(1.0f)) : one_less),
              reflectance.y / (shifts ? fma(-internal, reflectance.y, (Real)(1.0f)) : one_less),
              reflectance.z / (shifts ? fma(-internal, reflectance.z, (Real)(1.0f)) : one_less));
}

// a / (a + b), or 0 if both are 0.
static inline Real part_of(Real a, Real b) { return ratio_or_zero(a, a + b); }

#endif
