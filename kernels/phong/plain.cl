// Strategies whose density does not depend on the lobe. Before it includes this file, a strategy defines
// plain_direction(u1, u2) and plain_density(v), the density of a direction above the surface.
#ifndef PHLUX_PHONG_PLAIN_CL
#define PHLUX_PHONG_PLAIN_CL

#include "phong/shares.h"

static inline Real phong_survival(Phong m, Vec3 fixed, RandomDraws random) {
  return phong_survival_for(m, phong_lobe_reflectivity(m, fixed.z));
}

static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated, Real lobe) {
  return generated.z > 0.0f ? plain_density(generated) : (Real)(0.0f);
}

static inline LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Vec3 direction = plain_direction(uniform_real(random.words.y), uniform_real(random.words.z));
  LobeValue v;
  v.value = phong_value(m, phong_lobe(m, fixed, direction));
  v.density = phong_density(m, fixed, direction, (Real)(0.0f));
  return lobe_sample(direction, v);
}

#endif
