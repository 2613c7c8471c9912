// Choosing a light by what it is likely to bring to a point (Conty Estevez and Kulla, Importance Sampling of Many
// Lights with Adaptive Tree Splitting, 2018, without the splitting): down a binary tree of the lights that have a
// place, at each node to one of its two children in proportion to a bound on what they send to the point. A light's
// probability is the product of these choices. How light is reflected has no part in it: weights against the lobe's
// samples have.
#ifndef PHLUX_LIGHT_TREE_CL
#define PHLUX_LIGHT_TREE_CL

#include "random.h"
#include "scene.cl"

// No child is less likely than that: bounds are rounded, and what they take for dark must stay possible. It is also
// far above the spacing of uniform_real.
#define LEAST_LIKELY_CHILD 0.000244140625f
// Of the choices that could be the tree's, those that are by power all the same.
#define SHARE_BY_POWER 0.25f
// Of a distance, lest it be divided by 0.
#define LEAST_SQUARE 1e-36f

static inline Real sine_of(Real cosine) { return sqrt(larger(fma(-cosine, cosine, (Real)(1.0f)), (Real)(0.0f))); }

#define LIGHT_NODE_REAL(scene, index, member) GATHER_REAL((scene)->light_nodes, index, member)
#define LIGHT_NODE_INT(scene, index, member) GATHER_INT((scene)->light_nodes, index, member)
#define LIGHT_NODE_VEC3(scene, index, member) GATHER_VEC3((scene)->light_nodes, index, member)

// The largest cosine that the way to a point of a box can have to an axis: `center` is the way to the box's centre.
static inline Real largest_cosine(Vec3 axis, Vec3 center, Vec3 half_size, Real inv_distance) {
  const Real beyond = vec_dot(vec3(fabs(axis.x), fabs(axis.y), fabs(axis.z)), half_size);
  return clamp((vec_dot(axis, center) + beyond) * inv_distance, (Real)(-1.0f), (Real)(1.0f));
}

// In proportion to what the lights of a node, at the distance of their middle but each turned as well towards the point
// as one of them may be, would send to a surface there with that normal.
static inline Real node_importance(const Scene* scene, Int node, Vec3 lit, Vec3 normal) {
  const Vec3 half_size = LIGHT_NODE_VEC3(scene, node, half_size);
  const Vec3 center = vec_sub(LIGHT_NODE_VEC3(scene, node, center), lit);
  const Real distance2 = larger(vec_dot(center, center), vec_dot(half_size, half_size));
  const Vec3 gap =
      vec3(larger(fabs(center.x) - half_size.x, (Real)(0.0f)), larger(fabs(center.y) - half_size.y, (Real)(0.0f)),
           larger(fabs(center.z) - half_size.z, (Real)(0.0f)));
  const Real inv_least_distance = 1.0f / sqrt(larger(vec_dot(gap, gap), (Real)(LEAST_SQUARE)));
  const Real arriving = largest_cosine(normal, center, half_size, inv_least_distance);
  // The cosine of the angle from their normals, which are up to that of the cone's edge nearer than its axis.
  const Vec3 axis = LIGHT_NODE_VEC3(scene, node, axis);
  const Real cos_spread = LIGHT_NODE_REAL(scene, node, cos_spread);
  const Real cos_axis = largest_cosine(axis, vec_scale((Real)(-1.0f), center), half_size, inv_least_distance);
  const Real leaving =
      cos_axis > cos_spread ? (Real)(1.0f) : fma(cos_axis, cos_spread, sine_of(cos_axis) * sine_of(cos_spread));
  return LIGHT_NODE_REAL(scene, node, intensity) * larger(arriving, (Real)(0.0f)) * larger(leaving, (Real)(0.0f)) /
         larger(distance2, (Real)(LEAST_SQUARE));
}

// The probability of the child whose importance is `own`, not that of importance `other`.
static inline Real child_probability(Real own, Real other) {
  const Real both = own + other;
  const Real share = both > 0.0f ? own / both : (Real)(0.5f);
  return clamp(share, (Real)(LEAST_LIKELY_CHILD), (Real)(1.0f - LEAST_LIKELY_CHILD));
}

// The light that the tree chooses for a point with that normal in the lanes of m; elsewhere `light`.
static inline Int choose_from_tree(const Scene* scene, Vec3 lit, Vec3 normal, Uint word, Uint step, Mask m, Int light) {
  Int child = m ? (Int)(scene->light_nodes[0].child) : ~light;
  Mask descending = m;
  for (uint level = 2; any_lane(descending); ++level) {
    const Int first = descending ? child : (Int)(2);
    const Real likely_first =
        child_probability(node_importance(scene, first, lit, normal), node_importance(scene, first + 1, lit, normal));
    const Mask to_first = uniform_real(further_word(word, step, (Uint)(level))) < likely_first;
    const Int next = LIGHT_NODE_INT(scene, to_first ? first : first + 1, child);
    child = descending ? next : child;
    descending = child >= 0;
  }
  return ~child;
}

// The probability with which choose_from_tree chooses the light of this leaf, in the lanes of m; elsewhere 1.
static inline Real tree_probability(const Scene* scene, Vec3 lit, Vec3 normal, Int leaf, Mask m) {
  Real probability = (Real)(1.0f);
  Int node = leaf;
  for (Mask climbing = m; any_lane(climbing); climbing = m & (node > 0)) {
    const Int own = climbing ? node : (Int)(2), first = own & ~1;
    const Real likely_first =
        child_probability(node_importance(scene, first, lit, normal), node_importance(scene, first + 1, lit, normal));
    const Real likely = own == first ? likely_first : 1.0f - likely_first;
    probability *= climbing ? likely : (Real)(1.0f);
    node = climbing ? LIGHT_NODE_INT(scene, own, parent) : node;
  }
  return probability;
}

#endif
