// A table of one material, for kernels that measure a reflectance model without a scene.
#ifndef PHLUX_ONLY_MATERIAL_CL
#define PHLUX_ONLY_MATERIAL_CL

#include "lobes/material.cl"

// `front` as in material_at.
static inline Material only_material_from(const __global float* materials, const __global float* lobe_tables,
                                          Mask front) {
  Scene scene;
  scene.materials = materials;
  scene.lobe_tables = lobe_tables;
  TextureCoordinates nowhere;
  nowhere.u = nowhere.v = (Real)(0.0f);
  return material_at(&scene, (Int)(0), nowhere, front);
}
static inline Material only_material(const __global float* materials, const __global float* lobe_tables) {
  return only_material_from(materials, lobe_tables, ALL_LANES);
}

#endif
