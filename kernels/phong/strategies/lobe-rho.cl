// One part, chosen in proportion to kd and the exact reflectivity rho_s; the weight is that of the chosen part alone.
#define PHONG_WHOLE_WEIGHT 0
#define PHONG_FOLD 0
static inline Real phong_expected(Phong m, Real cosine) { return phong_lobe_reflectivity(m, cosine); }
static inline Real phong_estimate(Phong m, Vec3 fixed, RandomDraws random) { return phong_expected(m, fixed.z); }
#include "phong/one_part.cl"
