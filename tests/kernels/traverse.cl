#include "scene/surface.cl"
#include "scene/traverse_packet.cl"

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
  Vec3 origin, centre, across, down; // the same in every lane
} Bounds;

static inline void first_of(Vec3 v, Scalar* first) {
  Scalar lanes[LANES];
  lanes_to_array(v.x, lanes);
  first[0] = lanes[0];
  lanes_to_array(v.y, lanes);
  first[1] = lanes[0];
  lanes_to_array(v.z, lanes);
  first[2] = lanes[0];
}

// The first hits of the rays of a packet, along centre + a across + b down, found together and one by one.
__kernel void trace_packets(SCENE_PARAMETERS, __global const Bounds* bounds, __global const Real* a,
                            __global const Real* b, __global const Int* asks, __global Real* packet_distance,
                            __global Int* packet_material, __global Real* distance, __global Int* material,
                            __global Int* together) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const Mask asking = asks[i] != 0;
  PacketBounds packet;
  first_of(bounds[i].origin, packet.origin);
  first_of(bounds[i].centre, packet.direction);
  first_of(bounds[i].across, packet.across);
  first_of(bounds[i].down, packet.down);
  packet.terms = 4.0f;
  Ray ray;
  ray.origin = bounds[i].origin;
  ray.direction = vec_normalize(vec_along(vec_along(bounds[i].centre, a[i], bounds[i].across), b[i], bounds[i].down));
  const Hit by_packet = packet_intersect(&scene, ray, &packet, asking), alone = bvh_intersect(&scene, ray, asking);
  packet_distance[i] = by_packet.distance;
  packet_material[i] = material_of(&scene, by_packet);
  distance[i] = alone.distance;
  material[i] = material_of(&scene, alone);
  BoxRay fast;
  Vec3 far_inverse;
  together[i] = (Int)(bounding_rays(&packet, &fast, &far_inverse));
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
