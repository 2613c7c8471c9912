// Fresnel's equations for unpolarised light at the smooth surface between two media.
#ifndef PHLUX_FRESNEL_H
#define PHLUX_FRESNEL_H

#include "math/vectors.h"

// The index of refraction of the medium on the other side of a surface, relative to that on the side of a direction,
// the front or the back. `inside` is the index behind the surface, `outside` that in front of it.
static inline Real relative_index(Mask front, Real inside, Real outside) {
  return front ? inside / outside : outside / inside;
}

// From the cosines of the angles of incidence and refraction; `index` is the relative index of the far side.
static inline Real fresnel_reflectance(Real cosine, Real refracted_cosine, Real index) {
  const Real bent = index * refracted_cosine, straight = index * cosine;
  const Real s = (cosine - bent) / (cosine + bent), p = (straight - refracted_cosine) / (straight + refracted_cosine);
  return 0.5f * fma(s, s, p * p);
}

typedef struct {
  Real reflectance; // 1 at total internal reflection
  Real cosine;      // of the angle of refraction; 0 at total internal reflection
} Refraction;

// `index` is that of the far side, relative to that of the side of `direction`. The root is index cos(theta_t) by
// Snell's law: of index^2 - sin^2 or of cos^2 + index^2 - 1, whichever cancels less, so that equal media reflect
// nothing and do not bend light, also at grazing angles.
static inline Refraction refraction(Vec3 direction, Real index) {
  const Real cosine = direction.z, index2 = index * index;
  const Real sine2 = fma(direction.x, direction.x, direction.y * direction.y);
  const Real square = index2 < 0.5f ? index2 - sine2 : fma(cosine, cosine, (index - 1.0f) * (index + 1.0f));
  const Mask passes = square > 0.0f;
  const Real bent = sqrt(passes ? square : (Real)(1.0f));
  Refraction r;
  r.reflectance = passes ? fresnel_reflectance(cosine, bent / index, index) : (Real)(1.0f);
  r.cosine = passes ? bent / index : (Real)(0.0f);
  return r;
}

// For a direction at this cosine to the normal.
static inline Vec3 in_plane(Real cosine) {
  return vec3((Real)(0.0f), sqrt(larger(fma(-cosine, cosine, (Real)(1.0f)), (Real)(0.0f))), cosine);
}

static inline Vec3 mirrored(Vec3 direction) { return vec3(-direction.x, -direction.y, direction.z); }
static inline Vec3 refracted(Vec3 direction, Real index, Refraction r) {
  const Real shorter = -1.0f / index;
  return vec3(shorter * direction.x, shorter * direction.y, -r.cosine);
}

// Reflectance of a medium with the complex index of refraction eta + i k. (a + i b)^2 = (eta + i k)^2 - sin^2; the
// smaller of a and b is computed from a b = eta k, because the difference of squares would cancel.
static inline Real conductor_reflectance(Real cosine, Real eta, Real k) {
  const Real cosine2 = cosine * cosine, sine2 = larger(1.0f - cosine2, (Real)(0.0f));
  const Real difference = fma(eta, eta, fma(-k, k, -sine2)), product = eta * k;
  const Real sum = sqrt(fma(difference, difference, 4.0f * product * product)); // a^2 + b^2
  const Real larger_part = sqrt(0.5f * (sum + fabs(difference)));
  const Real a = difference > 0.0f ? larger_part : (larger_part > 0.0f ? product / larger_part : (Real)(0.0f));
  const Real across = 2.0f * a * cosine, along = across * sine2;
  const Real s_sum = sum + cosine2, p_sum = fma(cosine2, sum, sine2 * sine2);
  const Real s = (s_sum - across) / (s_sum + across);
  const Real p = p_sum + along > 0.0f ? (p_sum - along) / (p_sum + along) : (Real)(1.0f);
  return 0.5f * fma(s, p, s);
}
static inline Vec3 conductor_reflectances(Real cosine, Vec3 eta, Vec3 k) {
  return vec3(conductor_reflectance(cosine, eta.x, k.x), conductor_reflectance(cosine, eta.y, k.y),
              conductor_reflectance(cosine, eta.z, k.z));
}

#endif
