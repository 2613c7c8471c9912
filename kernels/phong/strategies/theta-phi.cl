// Uniform in (theta, phi), CW 197, section 4. The density is infinite at the normal; it is bounded there.
static inline Vec3 plain_direction(Real u1, Real u2) { return theta_phi_direction(u1, u2); }
static inline Real plain_density(Vec3 v) {
  return (INV_PI * INV_PI) / sqrt(larger(fma(v.x, v.x, v.y * v.y), (Real)(1e-16f)));
}
#include "phong/plain.cl"
