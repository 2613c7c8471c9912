// Directions from pairs of numbers uniform in (0, 1): the parametrizations of the hemisphere in CW 197, section 4, and
// the lobe. z is the normal, or the axis of the lobe. Densities are per solid angle.
#ifndef PHLUX_RANDOM_DIRECTIONS_H
#define PHLUX_RANDOM_DIRECTIONS_H

#include "math/angles.h"
#include "math/vectors.h"

static inline Vec3 polar_direction(Real sine, Real cosine, Real turns) {
  Real cos_phi, sin_phi;
  cos_sin_turns(turns, &cos_phi, &sin_phi);
  return vec3(sine * cos_phi, sine * sin_phi, cosine);
}

// (c, phi): density 1 / (2 pi).
static inline Vec3 hemisphere_direction(Real u1, Real u2) {
  return polar_direction(sqrt((1.0f - u1) * (1.0f + u1)), u1, u2);
}

// An offset with density 1 - |offset| over (-1, 1).
static inline Real tent_offset(Real u) { return u < 0.5f ? sqrt(2.0f * u) - 1.0f : 1.0f - sqrt(2.0f - 2.0f * u); }

// Uniform over the sphere: density 1 / (4 pi).
static inline Vec3 sphere_direction(Real u1, Real u2) {
  return polar_direction(2.0f * sqrt(u1 * (1.0f - u1)), 1.0f - 2.0f * u1, u2);
}

// (theta, phi): density 1 / (pi^2 sin(theta)).
static inline Vec3 theta_phi_direction(Real u1, Real u2) {
  Real cosine, sine;
  cos_sin_turns(0.25f * u1, &cosine, &sine);
  return polar_direction(sine, cosine, u2);
}

// (xi1, xi2): density cos(theta) / pi.
static inline Vec3 cosine_direction(Real u1, Real u2) { return polar_direction(sqrt(1.0f - u1), sqrt(u1), u2); }

// (x, y): density cos(theta) / pi as well, by Shirley and Chiu's concentric map (1997) of the square to the disk.
static inline Vec3 disk_direction(Real u1, Real u2) {
  const Real a = 2.0f * u1 - 1.0f, b = 2.0f * u2 - 1.0f;
  const Mask wide = fabs(a) > fabs(b);
  const Real radius = wide ? a : b;
  const Real turns = wide ? 0.125f * (b / a) : 0.25f - 0.125f * (a / b);
  const Vec3 v = polar_direction(radius, sqrt((1.0f - radius) * (1.0f + radius)), turns < 0.0f ? turns + 1.0f : turns);
  const Mask centre = radius == 0.0f;
  return vec3(centre ? (Real)(0.0f) : v.x, centre ? (Real)(0.0f) : v.y, v.z);
}

// cos(alpha) for sin^2(alpha) = -minus_sine2. cos^2(alpha) is at least half an ulp of 1, its rounding error: rounded to
// 0, it would give a sampled direction the density 0.
static inline Real lobe_cosine(Real minus_sine2) { return sqrt(larger(1.0f + minus_sine2, (Real)(REAL_HALF_ULP))); }

// Density (n + 1) / (2 pi) cos^n(alpha). sin^2(alpha) = -expm1(2 log(u) / (n + 1)) has a relative error of 1e-7 for
// every n; 1 - pow(u, 2 / (n + 1)) has one of 1 at n = 1e4.
static inline Vec3 cosine_power_direction(Real exponent, Real u1, Real u2) {
  const Real minus_sine2 = expm1(2.0f * log(u1) / (exponent + 1.0f));
  return polar_direction(sqrt(-minus_sine2), lobe_cosine(minus_sine2), u2);
}

#endif
