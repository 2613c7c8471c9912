// One part, chosen by kd and ks alone (seeds 003); the part that was sampled is weighted alone.
#define PHONG_WHOLE_WEIGHT 0
#define PHONG_FOLD 0
static inline Real phong_expected(Phong m, Real cosine) { return (Real)(1.0f); }
static inline Real phong_estimate(Phong m, Vec3 fixed, RandomDraws random) { return phong_expected(m, fixed.z); }
#include "phong/one_part.cl"
