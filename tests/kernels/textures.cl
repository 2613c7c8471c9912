#include "lobes/material.cl"
#include "scene/surface.cl"

// The colours of textures `number` at coordinates (u, v).
__kernel void look_up(SCENE_PARAMETERS, __global const Int* number, __global const TextureCoordinates* at,
                      __global Vec3* colour) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  colour[i] = texture_colour(&scene, number[i], at[i], ALL_LANES);
}

typedef struct {
  Real u, v;
  Vec3 tangent;
} Mapped;

// Texture coordinates and the frame's tangent where rays hit the scene.
__kernel void map(SCENE_PARAMETERS, __global const Ray* ray, __global Mapped* mapped) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const SurfacePoint point = surface_point(&scene, ray[i], scene_intersect(&scene, ray[i], ALL_LANES));
  Mapped to;
  to.u = point.uv.u;
  to.v = point.uv.v;
  to.tangent = point.frame.x;
  mapped[i] = to;
}

typedef struct {
  Vec3 value, direction, weight;
  Real density, reverse;
} Reflection;

// What a material makes of two directions, and of random numbers.
__kernel void reflect(SCENE_PARAMETERS, __global const Int* number, __global const TextureCoordinates* at,
                      __global const Vec3* fixed, __global const Vec3* generated, __global Reflection* reflection) {
  SCENE_FROM_PARAMETERS
  const size_t i = get_global_id(0);
  const Material material = material_at(&scene, number[i], at[i]);
  const LobeValue v = material_evaluate(material, fixed[i], generated[i]);
  RandomSequence sequence;
  sequence.pixel = (Uint)((uint)i);
  sequence.sample = (Uint)(0u);
  sequence.seed = (uint2)(1u, 2u);
  const MaterialSample s =
      material_sample(material, fixed[i], random_draws(sequence, (Uint)(0)), ALL_LANES, ALL_LANES);
  Reflection r;
  r.value = v.value;
  r.density = v.density;
  r.reverse = v.reverse;
  r.direction = s.direction;
  r.weight = s.weight;
  reflection[i] = r;
}
