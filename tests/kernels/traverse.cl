#include "scene/surface.cl"

typedef struct {
  Real distance;
  Int material, blocked;
} Traced;

static inline Int material_of(const Scene* scene, Hit hit) {
  const Int material = GATHER_INT(scene->primitives, max(hit.primitive, (Int)(0)), material);
  return hit.primitive >= 0 ? material : (Int)(-1);
}

// First hit of each ray with `asks` (the others: any), and whether a hit is before `limit` (the others: never).
__kernel void trace(SCENE_PARAMETERS, __global const Ray* ray, __global const Real* limit, __global const Int* asks,
                    __global Traced* traced) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const Mask asking = asks[i] != 0;
  const Hit hit = scene_intersect(&scene, ray[i], asking);
  Traced to;
  to.distance = hit.distance;
  to.material = material_of(&scene, hit);
  to.blocked = scene_occluded(&scene, ray[i], limit[i], asking) ? (Int)(1) : (Int)(0);
  traced[i] = to;
}

typedef struct {
  Int material, front, next_material, outward;
  Real distance, next_distance, error;
  Vec3 position, normal;
} Left;

// Rays that leave the surface that was hit: along `given`, in a frame whose z is the normal on the side of the arriving
// ray.
__kernel void leave(SCENE_PARAMETERS, __global const Ray* ray, __global const Vec3* given, __global Left* left) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const Hit hit = scene_intersect(&scene, ray[i], ALL_LANES);
  const SurfacePoint point = surface_point(&scene, ray[i], hit);
  Ray next;
  next.direction = from_frame(frame_about(point.normal), given[i]);
  next.origin = offset_origin(point.position, point.normal, point.error, next.direction);
  const Hit next_hit = scene_intersect(&scene, next, ALL_LANES);
  Left to;
  to.material = material_of(&scene, hit);
  to.front = point.front ? (Int)(1) : (Int)(0);
  to.next_material = material_of(&scene, next_hit);
  to.outward = vec_dot(point.normal, next.direction) > 0.0f ? (Int)(1) : (Int)(0);
  to.distance = hit.distance;
  to.next_distance = next_hit.distance;
  to.error = point.error;
  to.position = point.position;
  to.normal = point.normal;
  left[i] = to;
}
