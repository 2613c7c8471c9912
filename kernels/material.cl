// Materials: the reflectance model of the surface at hand, whichever it is, and its sides.
#ifndef PHLUX_MATERIAL_CL
#define PHLUX_MATERIAL_CL

#include "anisotropic.cl"
#include "phong.cl"
#include "scene.cl"

typedef struct {
  Phong phong;
#ifdef PHLUX_ANISOTROPIC
  Anisotropic anisotropic;
  Mask is_anisotropic;
#endif
} Material;

static inline Vec3 gather_material_rgb(const __global float* base, Int words) {
  return vec3(gather_real(base, words), gather_real(base + 1, words), gather_real(base + 2, words));
}

static inline Material material_at(const Scene* scene, Int index) {
  Material m;
  const Int words = index * (int)(sizeof(MaterialRecord) / 4);
  m.phong.diffuse = gather_material_rgb(scene->materials->diffuse, words);
#ifdef PHLUX_PHONG_LOBE
  m.phong.specular = gather_material_rgb(scene->materials->specular, words);
  m.phong.exponent = gather_real(&scene->materials->exponent, words);
  m.phong.diffuse_max = gather_real(&scene->materials->diffuse_max, words);
  m.phong.specular_max = gather_real(&scene->materials->specular_max, words);
  m.phong.table_scale = gather_real(&scene->materials->table_scale, words);
  m.phong.grazing_reflectivity = gather_real(&scene->materials->grazing_reflectivity, words);
  m.phong.table_row = gather_int(&scene->materials->table_row, words);
  m.phong.table = scene->reflectivity;
#endif
#ifdef PHLUX_ANISOTROPIC
  m.is_anisotropic = (gather_int(&scene->materials->flags, words) & MATERIAL_ANISOTROPIC) != 0;
  m.anisotropic.diffuse = m.phong.diffuse;
  m.anisotropic.specular = gather_material_rgb(scene->materials->specular, words);
  m.anisotropic.exponent_u = gather_real(&scene->materials->exponent, words);
  m.anisotropic.exponent_v = gather_real(&scene->materials->exponent_v, words);
  m.anisotropic.diffuse_max = gather_real(&scene->materials->diffuse_max, words);
  m.anisotropic.specular_max = gather_real(&scene->materials->specular_max, words);
#endif
  return m;
}

// Lanes whose surface reflects anything on the side that was hit.
static inline Mask reflects(const Scene* scene, Int material, Mask front) {
#if defined(PHLUX_TWO_SIDED) || defined(PHLUX_BLACK)
  const Int side = front ? (Int)(MATERIAL_FRONT) : (Int)(MATERIAL_BACK);
  return (GATHER_INT(scene->materials, material, flags) & side) != 0;
#else
  return front;
#endif
}

// The four functions of phong.cl, for whichever model the surface has.

static inline Vec3 material_eval(Material m, Vec3 fixed, Vec3 generated) {
  const Vec3 phong = phong_eval(m.phong, fixed, generated);
#ifdef PHLUX_ANISOTROPIC
  return vec_select(m.is_anisotropic, anisotropic_eval(m.anisotropic, fixed, generated), phong);
#else
  return phong;
#endif
}

static inline Real material_density(Material m, Vec3 fixed, Vec3 generated) {
  const Real phong = phong_density(m.phong, fixed, generated);
#ifdef PHLUX_ANISOTROPIC
  return m.is_anisotropic ? anisotropic_density(m.anisotropic, fixed, generated) : phong;
#else
  return phong;
#endif
}

static inline PhongSample material_sample(Material m, Vec3 fixed, RandomSequence sequence, Uint dimension,
                                          Mask roulette, Mask asked) {
  const PhongSample phong = phong_sample(m.phong, fixed, sequence, dimension, roulette, asked);
#ifdef PHLUX_ANISOTROPIC
  const PhongSample anisotropic = anisotropic_sample(m.anisotropic, fixed, sequence, dimension, roulette);
  PhongSample s;
  s.direction = vec_select(m.is_anisotropic, anisotropic.direction, phong.direction);
  s.weight = vec_select(m.is_anisotropic, anisotropic.weight, phong.weight);
  s.density = m.is_anisotropic ? anisotropic.density : phong.density;
  s.survives = (m.is_anisotropic & anisotropic.survives) | ((!m.is_anisotropic) & phong.survives);
  s.draws = phong.draws;
  return s;
#else
  return phong;
#endif
}

#endif
