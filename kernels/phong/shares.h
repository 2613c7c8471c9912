// How often a strategy samples the diffuse part and the lobe of the modified Phong model, and the survival probability
// of roulette, from what it takes for the reflectivity of the lobe.
#ifndef PHLUX_PHONG_SHARES_H
#define PHLUX_PHONG_SHARES_H

#include "phong/phong.cl"

typedef struct {
  Real diffuse, specular; // in proportion to the probability of sampling each part
} PhongShares;

// lobe_reflectivity: rho_s / ks, or an estimate of it.
static inline PhongShares phong_shares(Phong m, Real lobe_reflectivity) {
  PhongShares shares;
  shares.diffuse = m.diffuse_max;
  shares.specular = m.specular_max * lobe_reflectivity;
  return shares;
}

// The largest channel: with the channels' mean a path between red walls would have infinite variance in red.
static inline Real phong_survival_for(Phong m, Real lobe_reflectivity) {
  return vec_max(vec_along(m.diffuse_reflectance, lobe_reflectivity, m.specular_reflectance));
}

#endif
