// Uniform in (theta, phi), CW 197, section 4.
static inline Vec3 plain_direction(Real u1, Real u2) { return theta_phi_direction(u1, u2); }
static inline Real plain_density(Vec3 v) { return (INV_PI * INV_PI) / sqrt(fma(v.x, v.x, v.y * v.y)); }
#include "phong/plain.cl"
