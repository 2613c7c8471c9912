// Density cos / pi, by the (x, y) disk of CW 197, section 4.
static inline Vec3 plain_direction(Real u1, Real u2) { return disk_direction(u1, u2); }
static inline Real plain_density(Vec3 v) { return v.z * INV_PI; }
#include "phong/plain.cl"
