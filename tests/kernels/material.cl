#include "lobes/material.cl"

#define AT get_global_id(0)

__kernel void evaluate(SCENE_PARAMETERS, int material, __global const Vec3* fixed, __global const Vec3* generated,
                       __global Vec3* value) {
  SCENE_FROM_PARAMETERS
  value[AT] = material_evaluate(material_at(&scene, (Int)(material)), fixed[AT], generated[AT]).value;
}

__kernel void density_of(SCENE_PARAMETERS, int material, __global const Vec3* fixed, __global const Vec3* generated,
                         __global Real* density) {
  SCENE_FROM_PARAMETERS
  density[AT] = material_evaluate(material_at(&scene, (Int)(material)), fixed[AT], generated[AT]).density;
}

__kernel void reflectivity_of(SCENE_PARAMETERS, int material, __global const Real* cosine, __global Vec3* value) {
  SCENE_FROM_PARAMETERS
  const Real z = cosine[AT];
  const Vec3 fixed = vec3(sqrt((1.0f - z) * (1.0f + z)), (Real)(0.0f), z);
  value[AT] = material_reflectivity(material_at(&scene, (Int)(material)), fixed);
}

typedef struct {
  Vec3 direction, weight;
  Real density;
  Int survives, draws;
} Sample;

__kernel void sample_of(SCENE_PARAMETERS, int material, __global const Vec3* fixed, uint2 seed, int roulette,
                        __global const Uint* path, __global Sample* samples) {
  SCENE_FROM_PARAMETERS
  RandomSequence sequence;
  sequence.pixel = path[AT];
  sequence.sample = (Uint)(0u);
  sequence.seed = seed;
  const MaterialSample s =
      material_sample(material_at(&scene, (Int)(material)), fixed[AT], random_draws(sequence, (Uint)(0u)),
                      roulette ? ALL_LANES : NO_LANES, ALL_LANES);
  Sample to;
  to.direction = s.direction;
  to.weight = s.weight;
  to.density = s.density;
  to.survives = s.survives ? (Int)(1) : (Int)(0);
  to.draws = s.draws;
  samples[AT] = to;
}
