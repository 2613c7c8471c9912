// Only rays, for measuring traversal: each lane traces the rays lane, lane + stride, ... of an array of eight floats
// each (origin, direction, distance, unused).
#include "math/vectors.h"
#include "scene/scene.cl"
#include "scene/traverse.cl"

static inline Ray ray_at(const __global float* rays, Int index, Real* distance) {
  const Int words = index * 8;
  Ray ray;
  ray.origin = gather_vec(rays, words);
  ray.direction = gather_vec(rays + 3, words);
  *distance = gather_real(rays, words + 6);
  return ray;
}

// found[i]: the distance of the closest primitive on ray i; infinite if there is none.
__kernel void find_closest(SCENE_PARAMETERS, const __global float* rays, int ray_count, __global float* found) {
  SCENE_FROM_PARAMETERS
  const int stride = (int)get_global_size(0) * LANES;
  for (Int index = (int)get_global_id(0) * LANES + LANE_NUMBERS; any_lane(index < ray_count); index += stride) {
    const Mask asking = index < ray_count;
    Real distance;
    const Ray ray = ray_at(rays, asking ? index : (Int)(0), &distance);
    const Hit hit = scene_intersect(&scene, ray, asking);
    scatter_real(found, index, hit.primitive >= 0 ? hit.distance : (Real)(INFINITY), asking);
  }
}

// found[i]: 1 if a primitive is on ray i before its distance, else 0.
__kernel void find_any(SCENE_PARAMETERS, const __global float* rays, int ray_count, __global float* found) {
  SCENE_FROM_PARAMETERS
  const int stride = (int)get_global_size(0) * LANES;
  for (Int index = (int)get_global_id(0) * LANES + LANE_NUMBERS; any_lane(index < ray_count); index += stride) {
    const Mask asking = index < ray_count;
    Real distance;
    const Ray ray = ray_at(rays, asking ? index : (Int)(0), &distance);
    scatter_real(found, index, scene_occluded(&scene, ray, distance, asking) ? (Real)(1.0f) : (Real)(0.0f), asking);
  }
}
