// Density cos / pi, by the parameters (xi1, xi2) of CW 197, section 4. Exact for the diffuse part.
static inline Vec3 plain_direction(Real u1, Real u2) { return cosine_direction(u1, u2); }
static inline Real plain_density(Vec3 v) { return v.z * INV_PI; }
#include "phong/plain.cl"
