// One part, chosen by kd and a one-sample estimate of rho_s (CW 197, 3.3.1), mixed with ks so that it is never 0.
#define PHONG_WHOLE_WEIGHT 0
#define PHONG_FOLD 0
static inline Real phong_expected(Phong m, Real cosine) { return 0.5f + 0.5f * phong_lobe_reflectivity(m, cosine); }
#include "phong/estimate.h"
static inline Real phong_estimate(Phong m, Vec3 fixed, RandomDraws random) {
  return 0.5f + 0.5f * one_sample_estimate(m, fixed, random);
}
#include "phong/one_part.cl"
