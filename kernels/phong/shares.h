// Probabilities of sampling the diffuse part and the lobe of the modified Phong model, and the survival probability of
// roulette, from the strategy's value of the reflectivity of the lobe.
#ifndef PHLUX_PHONG_SHARES_H
#define PHLUX_PHONG_SHARES_H

#include "phong/phong.cl"

typedef struct {
  Real diffuse, specular; // proportional to the probabilities of sampling the parts
} PhongShares;

// lobe_reflectivity: rho_s / ks, or an estimate of it.
static inline PhongShares phong_shares(Phong m, Real lobe_reflectivity) {
  PhongShares shares;
  shares.diffuse = m.diffuse_max;
  shares.specular = m.specular_max * lobe_reflectivity;
  return shares;
}

// By the largest channel: with the mean of the channels a path between red walls would have infinite variance in red.
static inline Real phong_survival_for(Phong m, Real lobe_reflectivity) {
  return vec_max(vec_along(m.diffuse_reflectance, lobe_reflectivity, m.specular_reflectance));
}

#endif
