// A table of one Phong material, for kernels that measure phong.cl without a scene.
#ifndef PHLUX_ONLY_MATERIAL_CL
#define PHLUX_ONLY_MATERIAL_CL

#include "lobes/material.cl"

static inline Phong only_material(const __global MaterialRecord* materials, const __global float* reflectivity) {
  Scene scene;
  scene.materials = materials;
  scene.reflectivity = reflectivity;
  return material_at(&scene, (Int)(0)).phong;
}

#endif
