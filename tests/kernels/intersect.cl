#include "scene/intersect.cl"

typedef struct {
  Real u, v, distance, facing;
  Int triangle, parallelogram, ellipse;
} Crossing;

__kernel void planes(__global const Ray* ray, __global const Planar* planar, __global Crossing* crossing) {
  const size_t i = get_global_id(0);
  const PlaneCrossing c = cross_plane(ray[i], planar[i]);
  const Int yes = (Int)(1), no = (Int)(0);
  Crossing to;
  to.u = c.u;
  to.v = c.v;
  to.distance = c.distance;
  to.facing = c.facing;
  to.triangle = in_triangle(c) ? yes : no;
  to.parallelogram = in_parallelogram(c) ? yes : no;
  to.ellipse = in_ellipse(c) ? yes : no;
  crossing[i] = to;
}

// Whether each crossing is before a hit at this distance.
__kernel void before(__global const Ray* ray, __global const Planar* planar, __global const Real* limit,
                     __global Int* is_before) {
  const size_t i = get_global_id(0);
  is_before[i] = crosses_before(cross_plane(ray[i], planar[i]), no_hit_within(limit[i])) ? (Int)(1) : (Int)(0);
}

__kernel void spheres(__global const Ray* ray, __global const SphereShape* sphere, __global Real* distance) {
  const size_t i = get_global_id(0);
  distance[i] = cross_sphere(ray[i], sphere[i]);
}
