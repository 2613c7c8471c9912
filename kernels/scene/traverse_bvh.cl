// Traversal of a bounding volume hierarchy, one ray after another: the lanes test the children of a node or the
// primitives of a leaf together (with one lane the hierarchy is binary). On CPUs this is the fastest for scattered rays
// and shadow rays, which are incoherent. For camera rays see traverse_packet.cl.
#ifndef PHLUX_TRAVERSE_BVH_CL
#define PHLUX_TRAVERSE_BVH_CL

#include "scene/intersect.cl"
#include "scene/scene.cl"

#if LANES == 1
#define CHILDREN 2
#define STACK_SIZE (64 + CHILDREN) // max_depth_binary (host/accel/geometry.h), and the children of one node
#else
#define CHILDREN LANES
// max_depth_wide (host/accel/geometry.h) times the siblings of a node, and the children of one node.
#define STACK_SIZE (24 * (LANES - 1) + LANES)
#endif

// One ray, the same in every lane, prepared for box tests.
typedef struct {
  Ray ray;
  Vec3 inverse;               // of the direction; finite
  int near_x, near_y, near_z; // enum NodeValues of the planes that the ray crosses first
  int far_x, far_y, far_z;
} BoxRay;

// 1 / d, where |d| is at least 1e-20, so that the result is finite.
static inline Scalar finite_inverse(Scalar d) { return 1.0f / (fabs(d) < 1e-20f ? copysign((Scalar)(1e-20f), d) : d); }

static inline BoxRay box_ray(const Scalar* r) {
  BoxRay b;
  b.ray.origin = vec3((Real)(r[0]), (Real)(r[1]), (Real)(r[2]));
  b.ray.direction = vec3((Real)(r[3]), (Real)(r[4]), (Real)(r[5]));
  b.inverse = vec3((Real)(finite_inverse(r[3])), (Real)(finite_inverse(r[4])), (Real)(finite_inverse(r[5])));
  b.near_x = signbit(r[3]) ? NODE_HIGH_X : NODE_LOW_X;
  b.near_y = signbit(r[4]) ? NODE_HIGH_Y : NODE_LOW_Y;
  b.near_z = signbit(r[5]) ? NODE_HIGH_Z : NODE_LOW_Z;
  b.far_x = NODE_LOW_X + NODE_HIGH_X - b.near_x;
  b.far_y = NODE_LOW_Y + NODE_HIGH_Y - b.near_y;
  b.far_z = NODE_LOW_Z + NODE_HIGH_Z - b.near_z;
  return b;
}

// Factor of the distances to far planes, so that rounding errors make the ray miss no box (Ize 2013; pbrt, 6.8.2). With
// u = REAL_HALF_ULP, the relative error of (plane - origin) * (1 / direction) is at most gamma_7 = 7 u / (1 - 7 u): u
// of the difference, u of the product, and 5 u of the quotient (2.5 ulp; OpenCL 1.2, 7.4; only u on a CPU). The factor
// is at least (1 + gamma_7) / ((1 - gamma_7) (1 - u)) = 1 + 15 u + O(u^2); the last division is for its own product.
#define FAR_PLANE_FACTOR (1.0f + 16.0f * REAL_HALF_ULP)

// Pushes the children of a node that the ray hits before `limit`, the nearest last. Distances to far planes use
// `far_inverse`, which is b->inverse for a single ray.
static inline int push_children(const __global float* node, const BoxRay* b, Vec3 far_inverse, Scalar limit,
                                Scalar* nears, int* children, int top) {
  const int first = top;
  for (int group = 0; group < CHILDREN; group += LANES) {
    const __global float* boxes = node + group;
    const Real near_x = (load_reals(boxes + b->near_x * CHILDREN) - b->ray.origin.x) * b->inverse.x;
    const Real near_y = (load_reals(boxes + b->near_y * CHILDREN) - b->ray.origin.y) * b->inverse.y;
    const Real near_z = (load_reals(boxes + b->near_z * CHILDREN) - b->ray.origin.z) * b->inverse.z;
    const Real far_x = (load_reals(boxes + b->far_x * CHILDREN) - b->ray.origin.x) * far_inverse.x;
    const Real far_y = (load_reals(boxes + b->far_y * CHILDREN) - b->ray.origin.y) * far_inverse.y;
    const Real far_z = (load_reals(boxes + b->far_z * CHILDREN) - b->ray.origin.z) * far_inverse.z;
    const Real enter = larger(larger(near_x, near_y), larger(near_z, (Real)(0.0f)));
    const Real leave = smaller(smaller(far_x, far_y), far_z) * FAR_PLANE_FACTOR;
    const Mask met = (enter <= leave) & (enter < limit);
    top += append_lanes(met, enter, load_ints((const __global int*)boxes + NODE_CHILD * CHILDREN), nears + top,
                        children + top);
  }
  for (int i = first; i + 1 < top; ++i) {
    const int last = top - 1;
    if (nears[i] < nears[last]) {
      const Scalar near = nears[i];
      const int child = children[i];
      nears[i] = nears[last];
      children[i] = children[last];
      nears[last] = near;
      children[last] = child;
    }
  }
  return top;
}

// Three consecutive values of the flat primitives of a block.
static inline Vec3 load_planar(const __global Scalar* block, int value) {
  return vec3(load_scalars(block + value * LANES), load_scalars(block + (value + 1) * LANES),
              load_scalars(block + (value + 2) * LANES));
}

// The flat primitives of a block, one in each lane.
static inline Planar planars_of_block(const Scene* scene, int block) {
  const __global Scalar* values = scene->planars + block * (PLANAR_FLOATS * LANES);
  Planar p;
  p.origin = load_planar(values, PLANAR_ORIGIN);
  p.edge_v = load_planar(values, PLANAR_EDGE_V);
  p.minus_u = load_planar(values, PLANAR_MINUS_U);
  p.normal = load_planar(values, PLANAR_NORMAL);
  return p;
}

// Whether the primitives of a leaf of this kind are triangles, or spheres.
static inline int has_triangles(int kind) { return HAS_TRIANGLES & (!HAS_MIXED_REGIONS | (kind == REGION_TRIANGLE)); }
static inline int has_spheres(int kind) { return HAS_SPHERES & (!HAS_PLANARS | (kind == LEAF_SPHERES)); }

// Lanes in which the ray is inside a region of the kind of a leaf, which is the same in every lane.
static inline Mask in_region(PlaneCrossing c, int kind) {
  if (has_triangles(kind)) return in_triangle(c);
  if (HAS_ELLIPSES & (!HAS_PARALLELOGRAMS | (kind == REGION_ELLIPSE))) return in_ellipse(c);
  return in_parallelogram(c);
}

// The primitives of one block that the ray hits before `limit`, and their distances.
static inline Mask meet_planars(const Scene* scene, int block, int kind, Ray ray, Scalar limit, Real* distance) {
  const PlaneCrossing c = cross_plane(ray, planars_of_block(scene, block));
  const Mask inside = in_region(c, kind);
  const Mask met = inside & (c.distance > 0.0f) & (c.distance < limit * c.facing);
  *distance = c.distance / c.facing;
  return met;
}

static inline SphereShape spheres_of_block(const Scene* scene, int block) {
  const __global Scalar* values = scene->spheres + block * (SPHERE_FLOATS * LANES);
  SphereShape s;
  s.center = vec3(load_scalars(values), load_scalars(values + LANES), load_scalars(values + 2 * LANES));
  s.radius = load_scalars(values + 3 * LANES);
  return s;
}

static inline Mask meet_spheres(const Scene* scene, int block, Ray ray, Scalar limit, Real* distance) {
  *distance = cross_sphere(ray, spheres_of_block(scene, block));
  return (*distance > 0.0f) & (*distance < limit);
}

// The blocks of a leaf, and the kind of their primitives.
typedef struct {
  int first, end, kind;
} Leaf;

static inline Leaf leaf_of(int child) {
  const int code = ~child, first = code >> 5;
  const Leaf leaf = {first, first + ((code >> 2) & 7) + 1, code & 3};
  return leaf;
}

// The primitives of block `block` of a leaf; *first is the primitive index of its lane 0.
static inline Mask meet_block(const Scene* scene, int block, int kind, Ray ray, Scalar limit, Real* distance,
                              int* first) {
  if (has_spheres(kind)) {
    *first = scene->first_sphere + block * LANES;
    return meet_spheres(scene, block, ray, limit, distance);
  }
  *first = block * LANES;
  return meet_planars(scene, block, kind, ray, limit, distance);
}

// Finds the closest primitive before *distance; returns its index, or -1 without changing *distance.
static inline int closest_along(const Scene* scene, const Scalar* ray, Scalar* distance) {
  Scalar nears[STACK_SIZE];
  int children[STACK_SIZE];
  const BoxRay b = box_ray(ray);
  int found = -1, top = 1;
  nears[0] = 0.0f;
  children[0] = scene->root;
  while (top > 0) {
    --top;
    if (nears[top] >= *distance) continue;
    const int child = children[top];
    if (child >= 0) {
      top =
          push_children(scene->nodes + child * (NODE_WORDS * CHILDREN), &b, b.inverse, *distance, nears, children, top);
      continue;
    }
    const Leaf leaf = leaf_of(child);
    for (int block = leaf.first; block < leaf.end; ++block) {
      Real at;
      int first;
      const Mask met = meet_block(scene, block, leaf.kind, b.ray, *distance, &at, &first);
      if (any_lane(met)) {
        at = met ? at : (Real)(INFINITY);
        *distance = min_of_lanes(at);
        found = first + first_lane(at == *distance);
      }
    }
  }
  return found;
}

static inline int blocked_along(const Scene* scene, const Scalar* ray, Scalar distance) {
  Scalar nears[STACK_SIZE];
  int children[STACK_SIZE];
  const BoxRay b = box_ray(ray);
  int top = 1;
  nears[0] = 0.0f;
  children[0] = scene->root;
  while (top > 0) {
    --top;
    const int child = children[top];
    if (child >= 0) {
      top =
          push_children(scene->nodes + child * (NODE_WORDS * CHILDREN), &b, b.inverse, distance, nears, children, top);
      continue;
    }
    const Leaf leaf = leaf_of(child);
    for (int block = leaf.first; block < leaf.end; ++block) {
      Real at;
      int first;
      if (any_lane(meet_block(scene, block, leaf.kind, b.ray, distance, &at, &first))) return 1;
    }
  }
  return 0;
}

// Rays in an array with six floats per lane: origin, direction.
static inline void rays_to_array(Ray ray, Scalar (*array)[LANES]) {
  lanes_to_array(ray.origin.x, array[0]);
  lanes_to_array(ray.origin.y, array[1]);
  lanes_to_array(ray.origin.z, array[2]);
  lanes_to_array(ray.direction.x, array[3]);
  lanes_to_array(ray.direction.y, array[4]);
  lanes_to_array(ray.direction.z, array[5]);
}

static inline Hit bvh_intersect(const Scene* scene, Ray ray, Mask alive) {
  Scalar rays[6][LANES], distance[LANES];
  int asking[LANES], primitive[LANES];
  rays_to_array(ray, rays);
  int_lanes_to_array(alive, asking);
  for (int lane = 0; lane < LANES; ++lane) {
    const Scalar one[6] = {rays[0][lane], rays[1][lane], rays[2][lane], rays[3][lane], rays[4][lane], rays[5][lane]};
    distance[lane] = INFINITY;
    primitive[lane] = asking[lane] ? closest_along(scene, one, &distance[lane]) : -1;
  }
  Hit hit;
  hit.distance = lanes_from_array(distance);
  hit.primitive = int_lanes_from_array(primitive);
  return hit;
}

static inline Mask bvh_occluded(const Scene* scene, Ray ray, Real distance, Mask asking) {
  Scalar rays[6][LANES], limit[LANES];
  int asks[LANES], blocked[LANES];
  rays_to_array(ray, rays);
  lanes_to_array(distance, limit);
  int_lanes_to_array(asking, asks);
  for (int lane = 0; lane < LANES; ++lane) {
    const Scalar one[6] = {rays[0][lane], rays[1][lane], rays[2][lane], rays[3][lane], rays[4][lane], rays[5][lane]};
    blocked[lane] = asks[lane] ? blocked_along(scene, one, limit[lane]) : 0;
  }
  return int_lanes_from_array(blocked) != 0;
}

#endif
