// A sampling strategy of the Phong model: half of the directions by the cosine, half uniform over the hemisphere, with
// the density (cos(theta) / pi + 1 / (2 pi)) / 2.
#include "phong/shares.h"

static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated, Real lobe) {
  return generated.z > 0.0f ? 0.5f * INV_PI * (generated.z + 0.5f) : (Real)(0.0f);
}

// The first number chooses the half and then, from (0, 1) again, the height: sqrt(u) by the cosine, u if uniform.
static inline LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Real u = 2.0f * uniform_real(random.words.y);
  const Real height = u < 1.0f ? sqrt(u) : larger(u - 1.0f, (Real)(1e-7f));
  const Vec3 direction = polar_direction(sqrt((1.0f - height) * (1.0f + height)), height, uniform_real(random.words.z));
  LobeValue v;
  v.value = phong_value(m, phong_lobe(m, fixed, direction));
  v.density = phong_density(m, fixed, direction, (Real)(0.0f));
  return lobe_sample(direction, v);
}

static inline Real phong_survival(Phong m, Vec3 fixed, RandomDraws random) {
  return phong_survival_for(m, phong_lobe_reflectivity(m, fixed.z));
}
