#include "scene/emission.cl"

typedef struct {
  Vec3 origin, direction, radiance, position, normal;
  Real density, cosine;
  Real found; // density per area with which a light sample at `lit` chooses the point of a surface; 0: behind it
  Int light, surface, sky;
} Emitted;

__kernel void sample_emission(SCENE_PARAMETERS, uint2 seed, __global const Uint* path, __global const Vec3* lit,
                              __global Emitted* emitted) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  RandomSequence sequence;
  sequence.pixel = path[i];
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  const Emission e =
      emission_sample(&scene, random_words(sequence, (Uint)(0u), 0), random_words(sequence, (Uint)(1u), 0));
  const Int yes = (Int)(1), no = (Int)(0);
  Emitted to;
  to.origin = e.ray.origin;
  to.direction = e.ray.direction;
  to.radiance = e.radiance;
  to.position = e.origin.position;
  to.normal = e.origin.normal;
  to.density = e.density;
  to.cosine = vec_dot(e.origin.normal, e.ray.direction);
  to.light = e.light;
  to.surface = e.surface ? yes : no;
  to.sky = e.sky ? yes : no;
  const Vec3 way = vec_sub(e.origin.position, lit[i]);
  const Real distance = sqrt(vec_dot(way, way));
  const Real cosine = -vec_dot(e.origin.normal, way) / distance;
  const Real choice = LIGHT_REAL(&scene, e.light, probability);
  const Real per_angle = light_density(&scene, lit[i], e.light, choice, distance, cosine);
  const Real density = per_angle * cosine / (distance * distance);
  to.found = (e.surface & (cosine > 0.0f)) ? density : (Real)(0.0f);
  emitted[i] = to;
}
