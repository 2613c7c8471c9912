// The closest primitive along the ray of each lane, and tests for occlusion, by brute force or a hierarchy.
#ifndef PHLUX_TRAVERSE_CL
#define PHLUX_TRAVERSE_CL

#include "scene/traverse_brute.cl"
#include "scene/traverse_bvh.cl"

// The closest primitive along each ray of `alive`; both sides of primitives are hit.
static inline Hit scene_intersect(const Scene* scene, Ray ray, Mask alive) {
  if (HAS_BVH) return bvh_intersect(scene, ray, alive);
  return brute_intersect(scene, ray);
}

// Lanes of `asking` whose ray hits a primitive before `distance`.
static inline Mask scene_occluded(const Scene* scene, Ray ray, Real distance, Mask asking) {
  if (HAS_BVH) return bvh_occluded(scene, ray, distance, asking);
  return brute_occluded(scene, ray, distance, asking);
}

#endif
