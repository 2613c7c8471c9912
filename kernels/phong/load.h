// The parameters of the modified Phong model from plain numbers, for programs without records of materials
// (lobes/lobe.h).
#ifndef PHLUX_PHONG_LOAD_H
#define PHLUX_PHONG_LOAD_H

#include "phong/phong.cl"

// kd, ks and n in every lane. `table` has rows of PHONG_TABLE_INTERVALS + 1 values of rho_s / ks, one row for each
// exponent, at evenly spaced cosines from 0 to min(1, 6 / sqrt(n + 1)); the row of n begins at index `row`.
static inline Phong phong_from(Vec3 kd, Vec3 ks, Real n, const __global float* table, Int row) {
  Phong m;
  m.diffuse_reflectance = kd;
  m.specular_reflectance = ks;
  m.exponent = n;
  m.diffuse_max = vec_max(kd);
  m.specular_max = vec_max(ks);
  m.table_scale = (float)PHONG_TABLE_INTERVALS / smaller((Real)(1.0f), 6.0f / sqrt(n + 1.0f));
  m.grazing_reflectivity = gather_real(table, row); // at cosine 0
  m.table_row = row;
  m.tables = table;
  return m;
}

#endif
