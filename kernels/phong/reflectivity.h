// The reflectivity of the lobe without a table.
#ifndef PHLUX_PHONG_REFLECTIVITY_H
#define PHLUX_PHONG_REFLECTIVITY_H

#include "math/constants.h"

// rho_s / ks: (n + 2) / (2 pi) times the integral over the hemisphere of cos^n(alpha) cos(theta), if the axis of the
// lobe is at this cosine to the normal. It is equation (3) of sampling.md,
//
//     c (1 - I_{s^2}(n / 2 + 1, 1 / 2) / 2) + K s^(n + 2),
//
// where the factor of c is a probability of Student's t distribution with n + 2 degrees of freedom, computed by Hill's
// expansion about the normal distribution (Communications of the ACM 13, 1970, algorithm 395), and K is a ratio of
// Gamma functions, computed by three terms of a continued fraction. The relative error is at most 2e-5 for n >= 1, 3e-4
// for n >= 0.
static inline Real phong_reflectivity_of(Real exponent, Real cosine) {
  const Real minus_log_sine2 = -log1p(-cosine * cosine); // infinite at cosine 1
  const Real a = exponent + 1.5f, b = 48.0f * a * a;
  const Real w = smaller(sqrt(a * minus_log_sine2), (Real)(6.0f)); // beyond 6 the probability is 1 to 1e-9
  const Real w2 = w * w, w4 = w2 * w2;
  const Real second = (855.0f + w2 * (240.0f + w2 * (33.0f + 4.0f * w2))) / (10.0f * b * (b + 0.8f * w4 + 100.0f));
  const Real z = w * (1.0f + (3.0f + w2) / b - second);
  const Real above = 0.5f + 0.5f * erf(REAL(0.70710678118654752) * z); // 1 - I / 2
  const Real x = 0.5f * exponent + 1.0f;
  const Real gamma_ratio2 = x - 0.25f + 1.0f / (32.0f * x - 8.0f + 4.5f / x); // (Gamma(x + 1/2) / Gamma(x))^2
  const Real grazing = sqrt(gamma_ratio2 * INV_PI) / (exponent + 1.0f);       // K
  return fma(cosine, above, grazing * exp(-x * minus_log_sine2));
}

#endif
