// Uniform over the hemisphere: the parameters (c, phi) of CW 197, section 4.
static inline Vec3 plain_direction(Real u1, Real u2) { return hemisphere_direction(u1, u2); }
static inline Real plain_density(Vec3 v) { return (Real)(0.5f * INV_PI); }
#include "phong/plain.cl"
