// One part, chosen by kd and a one-sample estimate of rho_s as CW 197, 3.3.1 prints it. The estimate is 0 if its
// sample is below the surface: the lobe is then never chosen and its energy is lost. Biased; kept to show the bias.
#define PHONG_WHOLE_WEIGHT 0
#define PHONG_FOLD 0
static inline Real phong_expected(Phong m, Real cosine) { return phong_lobe_reflectivity(m, cosine); }
#include "phong/estimate.h"
static inline Real phong_estimate(Phong m, Vec3 fixed, RandomDraws random) {
  return one_sample_estimate(m, fixed, random);
}
#include "phong/one_part.cl"
