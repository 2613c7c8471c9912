// Strategies whose density is f_r cos / rho with the largest channels of kd and ks: for a grey material the weight of
// every sample is rho.
#ifndef PHLUX_PHONG_WHOLE_H
#define PHLUX_PHONG_WHOLE_H

#include "phong/shares.h"

static inline Real phong_survival(Phong m, Vec3 fixed, RandomDraws random) {
  return phong_survival_for(m, phong_lobe_reflectivity(m, fixed.z));
}

static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated, Real lobe) {
  const PhongShares shares = phong_shares(m, phong_lobe_reflectivity(m, fixed.z));
  const Real value = fma(lobe, m.specular_max, m.diffuse_max);
  return ratio_or_zero(larger(generated.z, (Real)(0.0f)) * INV_PI * value, shares.diffuse + shares.specular);
}

// The sample `direction`, with the density for these shares.
static inline LobeSample whole_sample(Phong m, Vec3 fixed, Vec3 direction, PhongShares shares) {
  const Real total = shares.diffuse + shares.specular;
  const Real lobe = phong_lobe(m, fixed, direction);
  const Real value = fma(lobe, m.specular_max, m.diffuse_max);
  const Vec3 colour = vec_along(m.diffuse_reflectance, lobe, m.specular_reflectance);
  LobeSample s;
  s.direction = direction;
  s.density = ratio_or_zero(larger(direction.z, (Real)(0.0f)) * INV_PI * value, total);
  s.weight = vec_scale(total, vec3(colour.x / value, colour.y / value, colour.z / value));
  s.weight = vec_select(value > 0.0f, s.weight, vec_all((Real)(0.0f)));
  s.delta = NO_LANES;
  s.draws = (Int)(1);
  return s;
}

#endif
