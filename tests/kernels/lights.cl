#include "scene/lights.cl"

typedef struct {
  Vec3 origin, direction, radiance;
  Real distance, density;
  Int hittable, valid, blocked, light; // light: index of the light that the ray hits, -1 for none
  Real hit_density;                    // density of the same ray, from its hit
  Int chosen;
  Real choice; // its probability
} Sampled;

__kernel void sample_lights(SCENE_PARAMETERS, __global const Vec3* position, __global const Vec3* normal,
                            uint2 seed, __global const Uint* path, __global Sampled* sampled) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  SurfacePoint lit;
  lit.position = position[i];
  lit.normal = normal[i];
  lit.frame = frame_about(normal[i]);
  lit.error = ERROR_UNITS * vec_largest(position[i]);
  lit.front = ALL_LANES;
  lit.material = (Int)(0);
  lit.light = (Int)(-1);
  RandomSequence sequence;
  sequence.pixel = path[i];
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  const LightSample s = light_sample(&scene, lit, random_draws(sequence, (Uint)(0u)));

  const Hit hit = scene_intersect(&scene, s.ray, s.valid);
  const SurfacePoint point = surface_point(&scene, s.ray, hit);
  const Mask emits = (hit.primitive >= 0) & point.front & (point.light >= 0);
  const Int light = max(point.light, (Int)(0));
  const Int yes = (Int)(1), no = (Int)(0);
  Sampled to;
  to.origin = s.ray.origin;
  to.direction = s.ray.direction;
  to.radiance = s.radiance;
  to.distance = s.distance;
  to.density = s.density;
  to.hittable = s.hittable ? yes : no;
  to.valid = s.valid ? yes : no;
  to.blocked = scene_occluded(&scene, s.ray, s.distance, s.valid) ? yes : no;
  to.light = emits ? light : (Int)(-1);
  to.chosen = s.light;
  to.choice = s.choice;
  const Real hit_choice = probability_for(&scene, s.ray.origin, lit.normal, light, emits);
  const Real cosine = -vec_dot(point.normal, s.ray.direction);
  to.hit_density = light_density(&scene, s.ray.origin, light, hit_choice, hit.distance, cosine);
  sampled[i] = to;
}

// Probability with which light_sample() chooses the light.
__kernel void light_choices(SCENE_PARAMETERS, __global const Vec3* position, __global const Vec3* normal,
                            int light, __global Real* probability) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  probability[i] = probability_for(&scene, position[i], normal[i], (Int)(light), ALL_LANES);
}
