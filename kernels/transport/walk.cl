// Subpaths from the eye or from a light, walking from surface to surface.
#ifndef PHLUX_WALK_CL
#define PHLUX_WALK_CL

#include "lobes/material.cl"
#include "math/random.h"
#include "scene/surface.cl"
#include "transport/weights.cl"

// Purposes of random words. Eye subpaths: dimension 0 is the place in the pixel, then two for every edge. Light
// subpaths: two for the first edge, then one for every edge. One for the roulette of connections.
#define DIMENSION_REFLECTION(edges) int_to_uint(2 * (edges))
#define DIMENSION_LIGHT(edges) int_to_uint(2 * (edges) + 1)
#define DIMENSION_EMISSION 0x40000000u
#define DIMENSION_LIGHT_PATH(edges) int_to_uint((edges) + 0x40000001)
#define DIMENSION_CONNECTIONS 0x60000000u

typedef struct {
  Ray ray;
  Vec3 throughput;
  Int edges; // of the subpath so far
  Int path;  // number in the batch
  RandomSequence sequence;
  // Bidirectional path tracing alone reads the rest.
  Ratios ratios;
  Vec3 normal;       // of the surface where the ray starts
  Int light;         // that it left, if it is a light subpath
  Real light_cosine; // of the first edge to that light's normal
  Real sky_density;  // with which light_sample chooses the ray's direction for a constant light
} Walk;

typedef struct {
  int edges;    // of the longest path
  int roulette; // decides from this edge on
} WalkLimits;

// A surface that a subpath has reached, and what it does there.
typedef struct {
  SurfacePoint point;
  Material material;
  Vec3 fixed; // back along the subpath, in the shading frame
} Vertex;

static inline Walk no_walk(uint2 seed) {
  Walk walk;
  walk.ray.origin = walk.ray.direction = walk.throughput = vec_all((Real)(0.0f));
  walk.edges = walk.path = (Int)(0);
  walk.sequence.pixel = walk.sequence.sample = (Uint)(0u);
  walk.sequence.seed = seed;
  walk.ratios.edge = walk.ratios.rest = walk.light_cosine = walk.sky_density = (Real)(0.0f);
  walk.normal = vec_all((Real)(0.0f));
  walk.light = (Int)(0);
  return walk;
}

static inline Vertex vertex_at(const Scene* scene, Ray ray, SurfacePoint point) {
  Vertex v;
  v.point = point;
  v.material = material_at(scene, point.material);
  v.fixed = to_frame(point.frame, vec_scale((Real)(-1.0f), ray.direction));
  return v;
}

// The cosines at the vertex of light that arrives along `fixed` and leaves along `generated` (in the shading frame;
// with its geometric cosine): Veach's (1997, 5.3) adjoint of f cos, over f. Without interpolated normals, the cosine of
// `generated`.
static inline Real adjoint_cosine(Vertex v, Vec3 generated, Real geometric_cosine) {
  if (!HAS_SMOOTH_NORMALS) return generated.z;
  return v.fixed.z * geometric_cosine / vec_dot(v.point.normal, from_frame(v.point.frame, v.fixed));
}

// Lanes whose surface reflects anything to the side that the ray came from.
static inline Mask can_reflect(const Scene* scene, Vertex v) {
  return (v.fixed.z > 0.0f) & reflects(scene, v.point.material, v.point.front);
}

// Both normals must agree that a direction leaves on this side: nothing shines through.
static inline Mask leaves(Vec3 generated, Real geometric_cosine) {
  return (generated.z > 0.0f) & (geometric_cosine > 0.0f);
}

// Reflects the subpaths of m; returns those that go on: not absorbed by roulette, and above the surface. Light subpaths
// (`adjoint`) carry power, eye subpaths importance.
static inline Mask walk_on(Walk* walk, Vertex v, int adjoint, Uint dimension, Mask roulette, Mask m) {
  const RandomDraws random = random_draws(walk->sequence, dimension);
  const MaterialSample sample = material_sample(v.material, v.fixed, random, roulette, m);
  const Vec3 direction = from_frame(v.point.frame, sample.direction);
  const Real cosine = vec_dot(v.point.normal, direction);
  Vec3 throughput = vec_mul(walk->throughput, sample.weight);
  if (HAS_SMOOTH_NORMALS && adjoint)
    throughput = vec_scale(adjoint_cosine(v, sample.direction, cosine) / sample.direction.z, throughput);
  const Mask goes_on = m & sample.survives & leaves(sample.direction, cosine) & (vec_max(throughput) > 0.0f);
  if (IS_BIDIR) {
    const Real reverse = material_evaluate(v.material, v.fixed, sample.direction).reverse;
    walk->ratios = ratios_reflected(walk->ratios, sample.density, reverse, cosine, sample.delta);
    walk->sky_density = sample.direction.z * INV_PI;
    walk->normal = v.point.normal;
  }
  walk->throughput = vec_select(goes_on, throughput, walk->throughput);
  walk->ray.origin = offset_origin(v.point.position, v.point.normal, v.point.error, direction);
  walk->ray.direction = direction;
  return goes_on;
}

#endif
