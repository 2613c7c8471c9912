// A table of one Phong material, for kernels that measure phong.cl without a scene.
#ifndef PHLUX_ONLY_MATERIAL_CL
#define PHLUX_ONLY_MATERIAL_CL

#include "material.cl"

static inline Phong only_material(const __global MaterialRecord* materials, const __global float* reflectivity) {
  Scene scene;
  scene.materials = materials;
#ifdef PHLUX_PHONG_LOBE
  scene.reflectivity = reflectivity;
#endif
  return material_at(&scene, (Int)(0)).phong;
}

#endif
