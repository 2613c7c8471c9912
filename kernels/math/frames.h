// Orthonormal frames. A direction in a frame has its component along the normal in z.
#ifndef PHLUX_FRAMES_H
#define PHLUX_FRAMES_H

#include "math/vectors.h"

typedef struct {
  Vec3 x, y, z;
} Frame;

// A right-handed frame about the unit vector z, by Duff et al., "Building an Orthonormal Basis, Revisited" (2017);
// orthonormal to a few ulp for every z.
static inline Frame frame_about(Vec3 z) {
  const Real sign = times_sign((Real)(1.0f), z.z);
  const Real a = -1.0f / (sign + z.z);
  const Real b = z.x * z.y * a;
  Frame f;
  f.x = vec3(fma(sign * z.x * z.x, a, (Real)(1.0f)), sign * b, -sign * z.x);
  f.y = vec3(b, fma(z.y * z.y, a, sign), -z.y);
  f.z = z;
  return f;
}

// A right-handed frame about the unit vector z whose x is along the projection of `tangent`, of any length; if
// `tangent` is (nearly) parallel to z or 0, any frame about z. The second projection removes the error that
// cancellation leaves in the first.
static inline Frame frame_along(Vec3 z, Vec3 tangent) {
  const Vec3 once = vec_along(tangent, -vec_dot(tangent, z), z);
  const Real length2 = vec_dot(once, once);
  const Mask usable = length2 > 1e-8f * vec_dot(tangent, tangent);
  const Vec3 unit = vec_scale(1.0f / sqrt(length2), once);
  const Vec3 x = vec_normalize(vec_along(unit, -vec_dot(unit, z), z));
  Frame f;
  f.x = vec_select(usable, x, frame_about(z).x);
  f.z = z;
  f.y = vec_cross(f.z, f.x);
  return f;
}

static inline Vec3 to_frame(Frame f, Vec3 v) { return vec3(vec_dot(f.x, v), vec_dot(f.y, v), vec_dot(f.z, v)); }

static inline Vec3 from_frame(Frame f, Vec3 v) { return vec_along(vec_along(vec_scale(v.x, f.x), v.y, f.y), v.z, f.z); }

// The frame of the mirror image of a direction about the normal: z along that image, x in the plane of image and
// normal, away from the normal, y perpendicular to both. It is computed from the components of the direction without
// cancellation.
typedef struct {
  Real cosine, sine; // of the angle between the direction (or its image) and the normal
  Real p, q;         // the direction lies in the plane of the normal and (p, q, 0)
} MirrorFrame;

static inline MirrorFrame mirror_frame(Vec3 direction) {
  MirrorFrame f;
  f.cosine = direction.z;
  f.sine = sqrt(fma(direction.x, direction.x, direction.y * direction.y));
  const Mask tilted = f.sine > 0.0f;
  f.p = tilted ? direction.x / f.sine : (Real)(1.0f);
  f.q = tilted ? direction.y / f.sine : (Real)(0.0f);
  return f;
}

static inline Vec3 from_mirror_frame(MirrorFrame f, Vec3 v) {
  const Real outward = fma(f.cosine, v.x, f.sine * v.z); // along -(p, q)
  return vec3(fma(f.q, v.y, -f.p * outward), -fma(f.p, v.y, f.q * outward), fma(f.cosine, v.z, -f.sine * v.x));
}

// The height of v, in the mirror frame, above the surface: its component along the normal.
static inline Real mirror_frame_height(MirrorFrame f, Vec3 v) { return fma(f.cosine, v.z, -f.sine * v.x); }

#endif
