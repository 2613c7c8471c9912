// Weights of bidirectional paths (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, chapters 9
// and 10), from two quantities that each subpath carries along (Georgiev, Implementing Vertex Connection and Merging,
// 2012, section 4, without its merging). A path that n techniques can make has the weight
//
//     1 / sum_i h(p_i / p)
//
// where p is the density of the technique at hand and h is the heuristic: the ratio (balance), its square (power), or 1
// if the technique can make the path at all (uniform). h(a b) = h(a) h(b), so that the sum is built edge by edge.
//
// Roulette is left out of the densities: the weights sum to 1 with any roulette. With it (Veach 10.3.3), where it decides
// at every vertex, the variance of bidir on scenes/two-phong-spheres.xml was 1.3% larger, and that of path 2.7% smaller;
// from edge 5 on, there would be none in the densities of paths of fewer edges.
// Densities of directions are per solid angle.
#ifndef PHLUX_MIS_WEIGHTS_CL
#define PHLUX_MIS_WEIGHTS_CL

#include "lanes/lanes.h"

#define WEIGHTS_BALANCE 0
#define WEIGHTS_POWER 1
#define WEIGHTS_UNIFORM 2

// Bound on the quantities, so that float can square them and multiply on. What exceeds it divides a weight below 1e-15,
// unless a scene is larger than 1e5 or smaller than 1e-6 and lengths enter to the fourth power (WEIGHTS_POWER).
#define LARGEST_RATIO REAL_LARGE

static inline Real heuristic(Real ratio) {
  if (WEIGHTS == WEIGHTS_BALANCE) return ratio;
  if (WEIGHTS == WEIGHTS_POWER) return ratio * ratio;
  return ratio > 0.0f ? (Real)(1.0f) : (Real)(0.0f);
}

// Georgiev's d^VCM and d^VC of a subpath's last vertex x_i (his equations 31 to 35), with h applied to every factor.
typedef struct {
  Real d_vcm; // h(1 / density of x_i), where for i = 1 the density of the connection to x_0 takes the place of 1
  Real d_vc;  // the sum over the techniques that make x_(i - 1) and more of this subpath from the other side, divided by
              // h(reverse density of x_(i - 1) as scattered at x_i)
} MisQuantities;

// The subpath arrives at x_i, `distance2` from x_(i - 1) (1 from a light at infinity), at this cosine to the geometric
// normal: densities per solid angle become densities per area (his equation 6).
static inline MisQuantities mis_arrived(MisQuantities q, Real distance2, Real cosine) {
  const Real per_cosine = heuristic(1.0f / cosine);
  q.d_vcm = smaller(q.d_vcm * heuristic(distance2) * per_cosine, (Real)(LARGEST_RATIO));
  q.d_vc = smaller(q.d_vc * per_cosine, (Real)(LARGEST_RATIO));
  return q;
}

// The subpath is scattered at x_i into a direction of this density and this cosine to the geometric normal; `reverse` is
// the density of the direction back to x_(i - 1), had the subpath come from there (his equations 33 and 34). No
// technique connects to a vertex with a delta event, and the densities of a delta event cancel (his section 5.2).
static inline MisQuantities mis_scattered(MisQuantities q, Real density, Real reverse, Real cosine, Mask delta) {
  MisQuantities next;
  next.d_vcm = heuristic(1.0f / density);
  next.d_vc = smaller(heuristic(cosine / density) * (q.d_vc * heuristic(reverse) + q.d_vcm), (Real)(LARGEST_RATIO));
  if (HAS_DELTA) {
    next.d_vcm = delta ? (Real)(0.0f) : next.d_vcm;
    next.d_vc = delta ? smaller(heuristic(cosine) * q.d_vc, (Real)(LARGEST_RATIO)) : next.d_vc;
  }
  return next;
}

// An eye subpath's first edge, whose direction has density `film` over the whole image (his equation 31).
static inline MisQuantities mis_from_eye(Real film) {
  MisQuantities q;
  q.d_vcm = heuristic(1.0f / film);
  q.d_vc = (Real)(0.0f);
  return q;
}

// A light subpath that has arrived at its first vertex (his equations 31 and 32): `light_sample` is the density with
// which a light sample there would have found its origin, `emission` the light's emission_density. Only a light that can
// be hit has a technique more.
static inline MisQuantities mis_from_light(Real light_sample, Real emission, Real cosine, Mask hittable) {
  MisQuantities q;
  q.d_vcm = smaller(heuristic(light_sample / (emission * cosine)), (Real)(LARGEST_RATIO));
  q.d_vc = hittable ? smaller(heuristic(1.0f / (emission * cosine)), (Real)(LARGEST_RATIO)) : (Real)(0.0f);
  return q;
}

// The sum over the techniques that make x_i and more of the subpath from the other side, where `reverse` is the density
// of the direction back to x_(i - 1).
static inline Real mis_sum(MisQuantities q, Real reverse) {
  return smaller(q.d_vcm + heuristic(reverse) * q.d_vc, (Real)(LARGEST_RATIO));
}

// ---- Weights of the techniques (his equations 36 to 46). `eye` and `light` are the quantities at the vertices that are
// connected.

// s = 0: the eye subpath hits a light that a light sample (on the first edge: a connection of the camera to it) finds
// with density `light_sample`; `leaving` are the quantities before mis_arrived.
static inline Real weight_of_hit(MisQuantities leaving, Real light_sample, Real emission) {
  return 1.0f / (1.0f + heuristic(light_sample) * leaving.d_vcm + heuristic(emission) * leaving.d_vc);
}

// s = 1: a light sample of density `light_sample`, in whose direction the vertex scatters with this density, at this
// cosine to its normal; `reverse`: the density of the direction that the eye subpath came from, coming from the light.
static inline Real weight_of_light_sample(MisQuantities eye, Real light_sample, Real emission, Real density,
                                          Real reverse, Real cosine, Mask hittable) {
  const Real by_hit = hittable ? heuristic(density / light_sample) : (Real)(0.0f);
  const Real by_light_path = heuristic(emission * cosine / light_sample) * mis_sum(eye, reverse);
  return 1.0f / (1.0f + by_hit + by_light_path);
}

// s = 1, t = 1: the camera sees the light's point itself. `film` is the density of that direction, `light_sample` that
// of the light's point per solid angle at the camera.
static inline Real weight_of_seen_light(Real film, Real light_sample) {
  return 1.0f / (1.0f + heuristic(film / light_sample));
}

// t = 1: the camera sees a vertex of a light subpath, at a squared distance and a cosine to its normal.
static inline Real weight_of_seen_vertex(MisQuantities light, Real film, Real reverse, Real distance2, Real cosine) {
  return 1.0f / (1.0f + heuristic(film * cosine / distance2) * mis_sum(light, reverse));
}

// s, t > 1: one side of a connection, the sum over the techniques that make the vertex with these quantities, and those
// before it, from the other side. `towards`: the density of the direction to the vertex; `reverse`: of the direction on,
// coming from there.
static inline Real connection_side(MisQuantities q, Real towards, Real reverse, Real distance2, Real cosine) {
  return heuristic(towards * cosine / distance2) * mis_sum(q, reverse);
}
static inline Real weight_of_connection(Real light_side, Real eye_side) {
  return 1.0f / (1.0f + light_side + eye_side);
}

#endif
