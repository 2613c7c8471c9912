// Subpaths from the camera and from the lights: their next vertex, and scattering there.
#ifndef PHLUX_SUBPATH_CL
#define PHLUX_SUBPATH_CL

#include "lobes/material.cl"
#include "math/random.h"
#include "scene/lights.cl"
#include "transport/launch.h"
#include "transport/masks.cl"
#include "transport/mis_weights.cl"

// Dimensions of the random numbers of a path. Eye subpaths have one for the position in the pixel (0), then two for
// every edge. Light subpaths have two for the first edge, one for every other edge, and one for every splat. The
// roulette of connections has one, and masks have one for every edge of both subpaths.
#define DIMENSION_SCATTERING(edges) int_to_uint(2 * (edges))
#define DIMENSION_LIGHT_SAMPLE(edges) int_to_uint(2 * (edges) + 1)
#define DIMENSION_EMISSION 0x40000000u
#define DIMENSION_LIGHT_SCATTERING(edges) int_to_uint((edges) + 0x40000001)
#define DIMENSION_CONNECTIONS 0x60000000u
#define DIMENSION_MASKS(edges, adjoint) int_to_uint((edges) + ((adjoint) ? 0x50000000 : 0x20000000))
#define DIMENSION_SPLAT(edges) int_to_uint((edges) + 0x70000000)

// A subpath and its next ray.
typedef struct {
  Ray ray;
  Vec3 throughput;   // of importance (eye subpaths) or power (light subpaths)
  Real unattenuated; // the throughput that it would have if no surface absorbed, for roulette by throughput
  Int edges;         // number of edges so far
  Int path;          // number in the batch
  RandomSequence sequence;
  // Quantities at the origin of the ray, from which the weights of the light that it finds are computed:
  Vec3 normal;             // lit_normal, on which the choice of a light depends
  Real density;            // of the ray's direction, per solid angle
  Real sky_sample_density; // density of the same direction as a light sample of a constant sky
  Mask delta;              // the direction was sampled from a delta distribution
  // Only in bidirectional path tracing:
  MisQuantities mis;
  Int light;         // light subpaths: where they started
  Real light_cosine; // light subpaths: of the first edge to the normal of the light; from the sky: its density
} Subpath;

// A vertex of a subpath on a surface.
typedef struct {
  SurfacePoint point;
  Material material;
  Vec3 fixed; // back along the subpath, in the shading frame
} Vertex;

static inline Subpath no_subpath(uint2 seed, PointSets sets) {
  Subpath s;
  s.ray.origin = s.ray.direction = s.throughput = s.normal = vec_all((Real)(0.0f));
  s.edges = s.path = s.light = (Int)(0);
  s.sequence.pixel = s.sequence.sample = (Uint)(0u);
  s.sequence.seed = seed;
  s.sequence.sets = sets;
  s.unattenuated = s.density = s.sky_sample_density = s.mis.d_vcm = s.mis.d_vc = s.light_cosine = (Real)(0.0f);
  s.delta = NO_LANES;
  return s;
}

// The intersections of the subpaths' rays with surfaces.
typedef struct {
  Real distance;
  Mask hits;      // a surface
  Mask scattered; // the surface scatters on this side, and the path may have more edges
  Vertex vertex;
} Arrival;

static inline Hit trace_edge(const Scene* scene, Subpath* s, int adjoint, Mask alive) {
  if (!HAS_MASKS) return scene_intersect(scene, s->ray, alive);
  const RandomWords words = random_words(s->sequence, DIMENSION_MASKS(s->edges, adjoint), 0);
  return first_scattering(scene, s->ray, words, &s->throughput, alive);
}

// Adds the edge to `hit`.
static inline Arrival arrive(const Scene* scene, Subpath* s, Hit hit, PathLimits limits, Mask alive) {
  s->edges += alive ? (Int)(1) : (Int)(0);
  Arrival a;
  a.distance = hit.distance;
  a.hits = alive & (hit.primitive >= 0);
  a.vertex.point = surface_point(scene, s->ray, hit);
  a.vertex.material = material_at(scene, a.vertex.point.material, a.vertex.point.uv, a.vertex.point.shaded_front);
  a.vertex.fixed = to_frame(a.vertex.point.frame, vec_scale((Real)(-1.0f), s->ray.direction));
  a.scattered = a.hits & (s->edges < limits.longest) & (a.vertex.fixed.z > 0.0f) &
                reflects(scene, a.vertex.point.material, a.vertex.point.shaded_front);
  return a;
}

// Traces the next edge. `adjoint`: 1 for light subpaths.
static inline Arrival next_vertex(const Scene* scene, Subpath* s, int adjoint, PathLimits limits, Mask alive) {
  return arrive(scene, s, trace_edge(scene, s, adjoint, alive), limits, alive);
}

// |cosine| if directions that count may have negative cosines.
static inline Real abs_cosine(Real cosine) { return HAS_SIGNED_COSINES ? fabs(cosine) : cosine; }

// The factor of f_r at the vertex of a light subpath that arrives along `fixed` and leaves along `generated` (in the
// shading frame; with its cosine to the geometric normal): Veach's adjoint BSDF (1997, 5.3) times cosine, divided by
// f_r. Without interpolated normals it is the cosine of `generated`. Cosines are not negative.
static inline Real adjoint_cosine(Vertex v, Vec3 generated, Real geometric_cosine) {
  if (!HAS_SMOOTH_NORMALS) return abs_cosine(generated.z);
  return v.fixed.z * abs_cosine(geometric_cosine) / vec_dot(v.point.normal, from_frame(v.point.frame, v.fixed));
}

// Lanes whose direction is above the surface by both normals, so that no light leaks through; by the shading normal
// alone if strictNormals is false. Directions below the surface count if the material transmits light.
static inline Mask leaves(Vec3 generated, Real geometric_cosine) {
  Mask above = generated.z > 0.0f, below = generated.z < 0.0f;
  if (!SIDES_BY_SHADING) {
    above = above & (geometric_cosine > 0.0f);
    below = below & (geometric_cosine < 0.0f);
  }
  return HAS_TRANSMISSION ? above | below : above;
}

// Scatters the subpaths of m. Returns those that roulette does not end. `adjoint`: 1 for light subpaths. *sample is the
// scattering event.
static inline Mask scatter(Subpath* s, Vertex v, int adjoint, Uint dimension, PathLimits limits, MaterialSample* sample,
                           Mask m) {
  *sample = material_sample(v.material, v.fixed, random_draws(s->sequence, dimension),
                            vec_scale(1.0f / s->unattenuated, s->throughput), s->edges >= limits.roulette, m);
  const Vec3 direction = from_frame(v.point.frame, sample->direction);
  const Real cosine = vec_dot(v.point.normal, direction);
  s->throughput = vec_mul(s->throughput, sample->weight);
  if (HAS_SMOOTH_NORMALS && adjoint)
    s->throughput =
        vec_scale(adjoint_cosine(v, sample->direction, cosine) / abs_cosine(sample->direction.z), s->throughput);
  const Real scale = radiance_scale(v.material, sample->direction);
  if (!adjoint) {
    s->throughput = vec_scale(scale, s->throughput);
    s->unattenuated *= scale;
  }
  if (IS_BIDIR) {
    const Real reverse = material_evaluate(v.material, v.fixed, sample->direction).reverse;
    Real jacobian = (Real)(1.0f); // of refraction: solid angle of `direction` / that of `fixed` (Veach 1997, 5.2)
    if (HAS_TRANSMISSION && HAS_DELTA)
      jacobian = sample->direction.z < 0.0f ? scale * v.fixed.z / -sample->direction.z : jacobian;
    s->mis = mis_scattered(s->mis, sample->density, reverse, abs_cosine(cosine), sample->delta, jacobian);
  }
  const Mask continues = m & sample->survives & leaves(sample->direction, cosine) & (vec_max(s->throughput) > 0.0f);
  s->normal = lit_normal(v.point);
  s->density = sample->density;
  s->sky_sample_density = sky_sample_density(v.point, sample->direction.z);
  s->delta = sample->delta;
  s->ray.origin = offset_origin(v.point.position, v.point.normal, v.point.error, direction);
  s->ray.direction = direction;
  return continues;
}

#endif
