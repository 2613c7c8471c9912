// Importance sampling of many lights (Conty Estevez and Kulla 2018, without their splitting): a binary tree over the
// lights with a position is descended. At each node one of the two children is chosen in proportion to bounds on the
// irradiance from their lights at the point. The probability of a light is the product of these probabilities. The
// bounds ignore f_r at the point; multiple importance sampling with reflected directions compensates for that.
#ifndef PHLUX_LIGHT_TREE_CL
#define PHLUX_LIGHT_TREE_CL

#include "math/random.h"
#include "scene/scene.cl"

// Lower bound on the probability of a child, so that rounding of the bounds never excludes a light. It is far above the
// spacing of uniform_real, 2^-23.
#define SMALLEST_CHILD_PROBABILITY 0.000244140625f
// The probability of choosing by power instead of by the tree, because lights with large bounds may be occluded.
#define POWER_SHARE 0.25f
// Lower bound on squared distances in denominators.
#define SMALLEST_SQUARE 1e-36f

static inline Real sine_of(Real cosine) { return sqrt(larger(fma(-cosine, cosine, (Real)(1.0f)), (Real)(0.0f))); }

#define LIGHT_NODE_REAL(scene, index, member) GATHER_REAL((scene)->light_nodes, index, member)
#define LIGHT_NODE_INT(scene, index, member) GATHER_INT((scene)->light_nodes, index, member)
#define LIGHT_NODE_VEC3(scene, index, member) GATHER_VEC3((scene)->light_nodes, index, member)

// The largest cosine between an axis and the direction to any point of a box; `center` is the vector to its centre.
static inline Real largest_cosine(Vec3 axis, Vec3 center, Vec3 half_size, Real inv_distance) {
  const Real beyond = vec_dot(vec3(fabs(axis.x), fabs(axis.y), fabs(axis.z)), half_size);
  return clamp((vec_dot(axis, center) + beyond) * inv_distance, (Real)(-1.0f), (Real)(1.0f));
}

// A bound, up to a factor, on the irradiance from the lights of a node at a surface with this normal (0: with any
// normal), for the distance of the centre of the box and the best orientation in the cone of normals.
static inline Real node_importance(const Scene* scene, Int node, Vec3 lit, Vec3 normal) {
  const Vec3 half_size = LIGHT_NODE_VEC3(scene, node, half_size);
  const Vec3 center = vec_sub(LIGHT_NODE_VEC3(scene, node, center), lit);
  const Real distance2 = larger(vec_dot(center, center), vec_dot(half_size, half_size));
  const Vec3 gap =
      vec3(larger(fabs(center.x) - half_size.x, (Real)(0.0f)), larger(fabs(center.y) - half_size.y, (Real)(0.0f)),
           larger(fabs(center.z) - half_size.z, (Real)(0.0f)));
  const Real inv_least_distance = 1.0f / sqrt(larger(vec_dot(gap, gap), (Real)(SMALLEST_SQUARE)));
  Real arriving = largest_cosine(normal, center, half_size, inv_least_distance);
  if (HAS_TRANSMISSION) arriving = vec_dot(normal, normal) > 0.0f ? arriving : (Real)(1.0f);
  // The largest cosine to a normal of the cone.
  const Vec3 axis = LIGHT_NODE_VEC3(scene, node, axis);
  const Real cos_spread = LIGHT_NODE_REAL(scene, node, cos_spread);
  const Real cos_axis = largest_cosine(axis, vec_scale((Real)(-1.0f), center), half_size, inv_least_distance);
  const Real leaving =
      cos_axis > cos_spread ? (Real)(1.0f) : fma(cos_axis, cos_spread, sine_of(cos_axis) * sine_of(cos_spread));
  return LIGHT_NODE_REAL(scene, node, intensity) * larger(arriving, (Real)(0.0f)) * larger(leaving, (Real)(0.0f)) /
         larger(distance2, (Real)(SMALLEST_SQUARE));
}

// The probability of the child with importance `own` if the other child has importance `other`.
static inline Real child_probability(Real own, Real other) {
  const Real both = own + other;
  const Real share = both > 0.0f ? own / both : (Real)(0.5f);
  return clamp(share, (Real)(SMALLEST_CHILD_PROBABILITY), (Real)(1.0f - SMALLEST_CHILD_PROBABILITY));
}

// The light that the tree chooses for a point with this normal in the lanes of m; `light` in other lanes.
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

// The probability with which choose_from_tree chooses the light of this leaf in the lanes of m; 1 in other lanes.
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
