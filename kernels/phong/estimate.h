// An estimate of the reflectivity of the lobe from one sample.
#ifndef PHLUX_PHONG_ESTIMATE_H
#define PHLUX_PHONG_ESTIMATE_H

#include "phong/phong.cl"

// rho_s / ks from one sample of the lobe (CW 197, 3.3.1); 0 if the sample is below the surface.
static inline Real one_sample_estimate(Phong m, Vec3 fixed, RandomDraws random) {
  const RandomWords words = draw_again(random, 1);
  const Vec3 v = cosine_power_direction(m.exponent, uniform_real(words.y), uniform_real(words.z));
  const Real height = mirror_frame_height(mirror_frame(fixed), v);
  return clamp((m.exponent + 2.0f) / (m.exponent + 1.0f) * height, (Real)(0.0f), (Real)(1.0f));
}

#endif
