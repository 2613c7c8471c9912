// Weights of bidirectional paths (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, chapters 9
// and 10), from two quantities that each subpath carries along (Georgiev, Implementing Vertex Connection and Merging,
// 2012, section 4, without its merging). A path that n techniques can make has the weight 1 / sum over them of h(p_i /
// p), where p is the density of the technique at hand and h is the heuristic: the ratio (balance), its square (power),
// or 1 if the technique can make the path at all (uniform). h(a b) = h(a) h(b), so the sum can be built edge by edge.
//
// Roulette is left out of the densities, which costs variance and no bias: a path that is made from one end has been
// through more of it than one that is joined in the middle, and gets somewhat more weight than is best.
// Densities of directions are per solid angle.
#ifndef PHLUX_WEIGHTS_CL
#define PHLUX_WEIGHTS_CL

#include "lanes/lanes.h"

#define WEIGHTS_BALANCE 0
#define WEIGHTS_POWER 1
#define WEIGHTS_UNIFORM 2

// Ratios that float could not square and multiply on are cut off. What they divide is then below 1e-15 of the rest,
// unless a scene is larger than 1e5 or smaller than 1e-6 and lengths enter to the fourth power (WEIGHTS_POWER).
#define LARGEST_RATIO REAL_LARGE

static inline Real heuristic(Real ratio) {
  if (WEIGHTS == WEIGHTS_BALANCE) return ratio;
  if (WEIGHTS == WEIGHTS_POWER) return ratio * ratio;
  return ratio > 0.0f ? (Real)(1.0f) : (Real)(0.0f);
}

// Of a subpath's last vertex x, as Georgiev's d^VCM and d^VC (his equations 31 to 35):
typedef struct {
  Real edge; // h(density of the connection from which the subpath began, if x is its second vertex / density of x):
             // what remains of the ratio of the technique that makes x from the other side
  Real rest; // the sum over the techniques that make still more of this subpath from the other side, over h(density
             // of the vertex before x as reflected at x)
} Ratios;

// A vertex is at hand: `distance2` from the one before (1 from a light at infinity), where the ray arrives at an angle
// of `cosine` to the surface's normal.
static inline Ratios ratios_arrived(Ratios r, Real distance2, Real cosine) {
  const Real per_cosine = heuristic(1.0f / cosine);
  r.edge = smaller(r.edge * heuristic(distance2) * per_cosine, (Real)(LARGEST_RATIO));
  r.rest = smaller(r.rest * per_cosine, (Real)(LARGEST_RATIO));
  return r;
}

// The subpath was reflected: the direction that it takes had density `forward`, and that back, had it come from
// there, `backward`; it leaves at an angle of `cosine` to the normal. Not yet arrived. No connection makes a path with a
// delta event at either of its ends, and the densities of a delta event and its reverse cancel (Georgiev 2012, 5.2).
static inline Ratios ratios_reflected(Ratios r, Real forward, Real backward, Real cosine, Mask delta) {
  Ratios next;
  next.edge = heuristic(1.0f / forward);
  next.rest = smaller(heuristic(cosine / forward) * (r.rest * heuristic(backward) + r.edge), (Real)(LARGEST_RATIO));
  if (HAS_DELTA) {
    next.edge = delta ? (Real)(0.0f) : next.edge;
    next.rest = delta ? smaller(heuristic(cosine) * r.rest, (Real)(LARGEST_RATIO)) : next.rest;
  }
  return next;
}

// An eye subpath's first edge, whose direction has density `film` over the whole image.
static inline Ratios ratios_from_eye(Real film) {
  Ratios r;
  r.edge = heuristic(1.0f / film);
  r.rest = (Real)(0.0f);
  return r;
}

// A light subpath that has arrived at its first vertex: `chosen` is the density with which a light sample there would
// have found its start, `emission` the light's emission_density. Only a light that can be hit has a technique more.
static inline Ratios ratios_from_light(Real chosen, Real emission, Real cosine, Mask hittable) {
  Ratios r;
  r.edge = smaller(heuristic(chosen / (emission * cosine)), (Real)(LARGEST_RATIO));
  r.rest = hittable ? smaller(heuristic(1.0f / (emission * cosine)), (Real)(LARGEST_RATIO)) : (Real)(0.0f);
  return r;
}

// The techniques that make more of the subpath from the other side, where `backward` is the density of its way on.
static inline Real rest_of(Ratios r, Real backward) {
  return smaller(r.edge + heuristic(backward) * r.rest, (Real)(LARGEST_RATIO));
}

// ---- Weights. `eye` and `light` are the ratios at the vertices that are joined.

// The eye subpath hit a light that a light sample (or, on the first edge, a connection of the eye to it) finds with
// density `chosen`; `not_arrived` are the ratios before ratios_arrived.
static inline Real weight_of_hit(Ratios not_arrived, Real chosen, Real emission) {
  return 1.0f / (1.0f + heuristic(chosen) * not_arrived.edge + heuristic(emission) * not_arrived.rest);
}

// A light sample of density `chosen`, in whose direction the vertex reflects with density `forward`, at an angle of
// `cosine` to its normal; `backward`: of the direction that the eye subpath came from, coming from the light.
static inline Real weight_of_light_sample(Ratios eye, Real chosen, Real emission, Real forward, Real backward,
                                          Real cosine, Mask hittable) {
  const Real by_hit = hittable ? heuristic(forward / chosen) : (Real)(0.0f);
  const Real by_light_path = heuristic(emission * cosine / chosen) * rest_of(eye, backward);
  return 1.0f / (1.0f + by_hit + by_light_path);
}

// The eye sees the light's point itself: `film` is the density of that direction, `chosen` that of the light's point
// per solid angle at the eye.
static inline Real weight_of_seen_light(Real film, Real chosen) { return 1.0f / (1.0f + heuristic(film / chosen)); }

// The eye sees a vertex of a light subpath `distance2` away, at an angle of `cosine` to its normal.
static inline Real weight_of_seen_vertex(Ratios light, Real film, Real backward, Real distance2, Real cosine) {
  return 1.0f / (1.0f + heuristic(film * cosine / distance2) * rest_of(light, backward));
}

// One side of a connection: the techniques that make the vertex with these ratios, and those before it, from the other
// side, where `towards` is the density of the direction to it; `backward`: of the way on, coming from there.
static inline Real connection_side(Ratios r, Real towards, Real backward, Real distance2, Real cosine) {
  return heuristic(towards * cosine / distance2) * rest_of(r, backward);
}
static inline Real weight_of_connection(Real light_side, Real eye_side) {
  return 1.0f / (1.0f + light_side + eye_side);
}

#endif
