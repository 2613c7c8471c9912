// As mixture, but a lobe sample below the surface is mirrored about the longitude psi = 0, so that no sample is lost.
#define PHONG_WHOLE_WEIGHT 1
#define PHONG_FOLD 1
static inline Real phong_expected(Phong m, Real cosine) { return phong_lobe_reflectivity(m, cosine); }
static inline Real phong_estimate(Phong m, Vec3 fixed, RandomDraws random) { return phong_expected(m, fixed.z); }
#include "phong/one_part.cl"
