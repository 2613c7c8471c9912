// Weights of bidirectional paths (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, chapters 9
// and 10), from two quantities of each subpath (Georgiev, Implementing Vertex Connection and Merging, technical report,
// 2012, without merging; his equations are cited by number). The weight of a path is
//
//     1 / sum_i h(p_i / p)
//
// where p is the density of the technique that made the path, the sum is over all techniques that can make it, and h is
// the heuristic: the ratio (balance), its square (power), or 1 (uniform). h(a b) = h(a) h(b), so that the sum can be
// computed edge by edge.
//
// Densities do not include survival probabilities of roulette; the weights add up to 1 with any roulette. When they
// were included (Veach 10.3.3), with roulette at every vertex of scenes/two-phong-spheres.xml, variance x rays was 1.3%
// larger for bidir and 2.7% smaller for path (bench/saved/ROULETTE.md). With roulette from edge 5 on, paths of fewer
// edges have no survival probabilities. Densities of directions are per solid angle.
#ifndef PHLUX_MIS_WEIGHTS_CL
#define PHLUX_MIS_WEIGHTS_CL

#include "lanes/lanes.h"

#define WEIGHTS_BALANCE 0
#define WEIGHTS_POWER 1
#define WEIGHTS_UNIFORM 2

// Factors and quantities are finite, so that a product with 0 is 0 and not NaN. A value that overflows, or 0 / 0,
// becomes the largest number: the weight is then 0 in float32, unless the other factors are below 1e-38.
static inline Real bounded(Real x) { return smaller(x, (Real)(REAL_MAX)); }

static inline Real heuristic(Real ratio) {
  if (WEIGHTS == WEIGHTS_BALANCE) return bounded(ratio);
  if (WEIGHTS == WEIGHTS_POWER) return bounded(ratio * ratio);
  return ratio > 0.0f ? (Real)(1.0f) : (Real)(0.0f);
}

// Georgiev's d^VCM and d^VC of the last vertex x_i of a subpath (equations 31, 32, 34 and 35), with h applied to
// every factor.
typedef struct {
  Real d_vcm; // h(1 / density of x_i); for i = 1 the density of the connection to x_0 replaces the 1
  Real d_vc;  // sum over the techniques that sample x_(i - 1), and possibly vertices before it, from the other side,
              // divided by h(reverse density of x_(i - 1) as scattered at x_i)
} MisQuantities;

// The subpath arrives at x_i, at the squared distance `distance2` from x_(i - 1) (1 from a light at infinity) and at
// this cosine to the geometric normal. Converts densities per solid angle to densities per area, by cos / distance^2.
static inline MisQuantities mis_arrived(MisQuantities q, Real distance2, Real cosine) {
  const Real per_cosine = heuristic(1.0f / cosine);
  q.d_vcm = bounded(q.d_vcm * heuristic(distance2) * per_cosine);
  q.d_vc = bounded(q.d_vc * per_cosine);
  return q;
}

// The subpath is scattered at x_i into a direction of this density and this cosine to the geometric normal; `reverse`
// is the density of the direction back to x_(i - 1) for a subpath that comes from the other side (equations 34 and 35).
// No technique connects to a vertex with a delta event, and the ratio of the densities of a delta event from both sides
// is 1 (equations 53 and 54); for refraction it is `jacobian`.
static inline MisQuantities mis_scattered(MisQuantities q, Real density, Real reverse, Real cosine, Mask delta,
                                          Real jacobian) {
  MisQuantities next;
  next.d_vcm = heuristic(1.0f / density);
  // One ratio of both densities: the square of the density of a narrow lobe may overflow, but not that of their ratio.
  next.d_vc = bounded(heuristic(cosine * reverse / density) * q.d_vc + heuristic(cosine / density) * q.d_vcm);
  if (HAS_DELTA) {
    next.d_vcm = delta ? (Real)(0.0f) : next.d_vcm;
    next.d_vc = delta ? bounded(heuristic(cosine * jacobian) * q.d_vc) : next.d_vc;
  }
  return next;
}

// The first edge of an eye subpath, whose direction has the density `film` over the whole image (equations 31 and
// 32).
static inline MisQuantities mis_from_eye(Real film) {
  MisQuantities q;
  q.d_vcm = heuristic(1.0f / film);
  q.d_vc = (Real)(0.0f);
  return q;
}

// A light subpath that has arrived at its first vertex (equations 31 and 32). `light_sample` is the density with
// which a light sample there would have found its origin, `emission` is the emission_density of the light. Only a light
// that can be hit has the additional technique s = 0.
static inline MisQuantities mis_from_light(Real light_sample, Real emission, Real cosine, Mask hittable) {
  MisQuantities q;
  q.d_vcm = heuristic(light_sample / (emission * cosine));
  q.d_vc = hittable ? heuristic(1.0f / (emission * cosine)) : (Real)(0.0f);
  return q;
}

// The sum over the techniques that sample x_i, and possibly vertices before it, from the other side; `reverse` is the
// density of the direction back to x_(i - 1).
static inline Real mis_sum(MisQuantities q, Real reverse) { return bounded(q.d_vcm + heuristic(reverse) * q.d_vc); }

// ---- Weights of the techniques (equation 37). `eye` and `light` are the quantities at the connected vertices.

// s = 0 (equation 43): the eye subpath hits a light. `light_sample` is the density with which a light sample (for the
// first edge: a connection of the light to the camera) finds the point; `leaving` are the quantities before
// mis_arrived.
static inline Real weight_of_hit(MisQuantities leaving, Real light_sample, Real emission) {
  return 1.0f / (1.0f + heuristic(light_sample) * leaving.d_vcm + heuristic(emission) * leaving.d_vc);
}

// s = 1 (equations 44 and 45): a light sample with density `light_sample`. `density` is that of scattering in its
// direction, at this cosine to the normal; `reverse` is the density of scattering from the light back along the eye
// subpath.
static inline Real weight_of_light_sample(MisQuantities eye, Real light_sample, Real emission, Real density,
                                          Real reverse, Real cosine, Mask hittable) {
  const Real by_hit = hittable ? heuristic(density / light_sample) : (Real)(0.0f);
  const Real by_light_path = heuristic(emission * cosine / light_sample) * mis_sum(eye, reverse);
  return 1.0f / (1.0f + by_hit + by_light_path);
}

// s = 1, t = 1: the camera sees the point on the light itself. `film` is the density of that direction, `light_sample`
// that of the point on the light, per solid angle at the camera.
static inline Real weight_of_seen_light(Real film, Real light_sample) {
  return 1.0f / (1.0f + heuristic(film / light_sample));
}

// t = 1 (equation 46): the camera sees a vertex of a light subpath, at this squared distance and cosine to the normal.
static inline Real weight_of_seen_vertex(MisQuantities light, Real film, Real reverse, Real distance2, Real cosine) {
  return 1.0f / (1.0f + heuristic(film * cosine / distance2) * mis_sum(light, reverse));
}

// s, t > 1 (equations 40 and 41): one side of a connection, the sum over the techniques that sample the vertex with
// these quantities, and possibly vertices before it, from the other side. `towards` is the density of the direction to
// the vertex; `reverse` is that of scattering there back along its subpath.
static inline Real connection_side(MisQuantities q, Real towards, Real reverse, Real distance2, Real cosine) {
  return heuristic(towards * cosine / distance2) * mis_sum(q, reverse);
}
static inline Real weight_of_connection(Real light_side, Real eye_side) {
  return 1.0f / (1.0f + light_side + eye_side);
}

#endif
