// Traversal of the hierarchy by a packet: the rays of all lanes start at one point, and their directions differ little,
// like those of a pixel's camera rays. Nodes and primitives are tested with bounds of all rays at once (Boulos, Wald
// and Shirley 2006), and each ray only with the primitives that remain.
#ifndef PHLUX_TRAVERSE_PACKET_CL
#define PHLUX_TRAVERSE_PACKET_CL

#include "scene/traverse_brute.cl"
#include "scene/traverse_bvh.cl"

// Bounds of the rays of a packet: they start at `origin`, with the directions direction + a across + b down for |a| <=
// 1 and |b| <= 1. These vectors are not normalized; their lengths are at least 1, so that the parameter t of a point is
// at most its distance, and what begins at t >= limit can be left out.
typedef struct {
  Scalar origin[3], direction[3], across[3], down[3];
  Scalar terms; // at least the sum of the absolute values of the terms of any direction's components
} PacketBounds;

// A bound on the rounding errors of directions and intersection tests, relative to the sum of their terms' absolute
// values.
#define PACKET_MARGIN 4e-6f

// Three scalars, in every lane.
static inline Vec3 vec_of(const Scalar* v) { return vec3((Real)(v[0]), (Real)(v[1]), (Real)(v[2])); }

// Two rays that bound the packet in box tests. *fast has the largest component of any direction along each axis: the
// distance at which it crosses a plane in front of the origin is at most that of any ray. *far_inverse is the inverse
// of the smallest components, for which the distance is at least that of any ray. Returns 0 if rays of the packet may
// differ in the sign of a component: there are then no such bounds.
static inline int bounding_rays(const PacketBounds* packet, BoxRay* fast, Vec3* far_inverse) {
  Scalar fastest[6], slowest[6];
  int same_signs = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const Scalar middle = packet->direction[axis];
    const Scalar spread = fabs(packet->across[axis]) + fabs(packet->down[axis]) + PACKET_MARGIN * packet->terms;
    same_signs &= fabs(middle) > spread;
    fastest[axis] = slowest[axis] = packet->origin[axis];
    fastest[axis + 3] = middle + copysign(spread, middle);
    slowest[axis + 3] = middle - copysign(spread, middle);
  }
  *fast = box_ray(fastest);
  *far_inverse = box_ray(slowest).inverse;
  return same_signs;
}

// A bound on |v . (the direction of a ray - packet->direction)|, including rounding errors; `size` bounds v.
static inline Real spread_of(const PacketBounds* packet, Vec3 v, Real size) {
  return fabs(vec_dot(v, vec_of(packet->across))) + fabs(vec_dot(v, vec_of(packet->down))) +
         PACKET_MARGIN * packet->terms * size;
}

// The primitives of a block that rays of the packet may hit before `limit`. Up to the sign of `towards`, u, v and
// facing of cross_plane are linear in the direction, and its distance does not depend on it.
static inline Mask planars_near(const PacketBounds* packet, Planar p, int kind, Scalar limit) {
  const Vec3 direction = vec_of(packet->direction);
  const Vec3 from_origin = vec_sub(vec_of(packet->origin), p.origin);
  const Real length = vec_largest(from_origin);
  const Vec3 for_u = vec_cross(p.edge_v, from_origin), for_v = vec_cross(p.minus_u, from_origin);
  const Real towards = -vec_dot(p.normal, direction), towards_spread = spread_of(packet, p.normal, (Real)(1.0f));
  const Real facing = fabs(towards) + towards_spread;
  const Real u = times_sign(vec_dot(for_u, direction), towards);
  const Real v = times_sign(vec_dot(for_v, direction), towards);
  const Real u_spread = spread_of(packet, for_u, length * vec_largest(p.edge_v));
  const Real v_spread = spread_of(packet, for_v, length * vec_largest(p.minus_u));
  const Real distance = times_sign(vec_dot(p.normal, from_origin), towards);
  Mask missed = (distance < 0.0f) | (distance > limit * facing);
  if (has_triangles(kind))
    missed |= (u + u_spread < 0.0f) | (v + v_spread < 0.0f) | (u + v - u_spread - v_spread > facing);
  else
    missed |= (fabs(u) - u_spread > facing) | (fabs(v) - v_spread > facing);
  const Mask edge_on = fabs(towards) <= towards_spread; // rays of the packet may differ in the sign of `towards`
  return (edge_on | !missed) & (distance != 0.0f);
}

// The same for spheres, without a limit, by the distances of their centres from the rays.
static inline Mask spheres_near(const PacketBounds* packet, SphereShape s) {
  const Vec3 direction = vec_of(packet->direction);
  const Vec3 from_center = vec_sub(vec_of(packet->origin), s.center);
  const Vec3 across = vec_of(packet->across), down = vec_of(packet->down), moment = vec_cross(from_center, direction);
  const Real spread = sqrt(vec_dot(across, across)) + sqrt(vec_dot(down, down)) + PACKET_MARGIN * packet->terms;
  const Real reach =
      sqrt(vec_dot(from_center, from_center)) * spread + s.radius * (sqrt(vec_dot(direction, direction)) + spread);
  return vec_dot(moment, moment) <= reach * reach;
}

// Tests the rays with the primitive in `lane` of a block. Hits closer than *hit replace it.
static inline void meet_primitive(const Scene* scene, int block, int lane, int kind, Ray ray, Hit* hit) {
  Real distance;
  Mask met;
  int first; // primitive index of lane 0 of block 0
  if (has_spheres(kind)) {
    const SphereShape s = sphere_at(scene->spheres + block * (SPHERE_FLOATS * LANES) + lane, LANES);
    first = scene->first_sphere;
    distance = cross_sphere(ray, s);
    met = (distance > 0.0f) & (distance < hit->distance);
  } else {
    const Planar p = planar_at(scene->planars + block * (PLANAR_FLOATS * LANES) + lane, LANES);
    const PlaneCrossing c = cross_plane(ray, p);
    first = 0;
    distance = c.distance / c.facing;
    met = in_region(c, kind) & (c.distance > 0.0f) & (c.distance < hit->distance * c.facing);
  }
  hit->distance = met ? distance : hit->distance;
  hit->primitive = met ? (Int)(first + block * LANES + lane) : hit->primitive;
}

// Finds the closest primitive along each ray of m, whose bounds are `packet`.
static inline Hit closest_of_packet(const Scene* scene, Ray ray, const PacketBounds* packet, const BoxRay* fast,
                                    Vec3 far_inverse, Mask m) {
  Scalar nears[STACK_SIZE];
  int children[STACK_SIZE];
  Hit hit;
  hit.distance = m ? (Real)(INFINITY) : (Real)(0.0f);
  hit.primitive = (Int)(-1);
  Scalar limit = INFINITY; // the largest distance of all rays
  int top = 1;
  nears[0] = 0.0f;
  children[0] = scene->root;
  while (top > 0) {
    --top;
    if (nears[top] >= limit) continue;
    const int child = children[top];
    if (child >= 0) {
      top =
          push_children(scene->nodes + child * (NODE_WORDS * CHILDREN), fast, far_inverse, limit, nears, children, top);
      continue;
    }
    const Leaf leaf = leaf_of(child);
    for (int block = leaf.first; block < leaf.end; ++block) {
      Mask candidates = has_spheres(leaf.kind) ? spheres_near(packet, spheres_of_block(scene, block))
                                               : planars_near(packet, planars_of_block(scene, block), leaf.kind, limit);
      while (any_lane(candidates)) {
        const int lane = first_lane(candidates);
        candidates &= LANE_NUMBERS != lane;
        meet_primitive(scene, block, lane, leaf.kind, ray, &hit);
      }
      limit = max_of_lanes(hit.distance);
    }
  }
  return hit;
}

// As bvh_intersect, for rays of which `packet` has the bounds.
static inline Hit packet_intersect(const Scene* scene, Ray ray, const PacketBounds* packet, Mask alive) {
  BoxRay fast;
  Vec3 far_inverse;
  if (!bounding_rays(packet, &fast, &far_inverse)) return bvh_intersect(scene, ray, alive);
  return closest_of_packet(scene, ray, packet, &fast, far_inverse, alive);
}

#endif
