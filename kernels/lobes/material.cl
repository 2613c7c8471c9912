// Materials: the reflectance model of the surface at hand, whichever it is, and its sides.
#ifndef PHLUX_MATERIAL_CL
#define PHLUX_MATERIAL_CL

#include "lobes/anisotropicphong.cl"
#include "phong/phong.cl"
#include "scene/scene.cl"

typedef struct {
  Phong phong;
#if HAS_ANISOTROPIC
  Anisotropic anisotropic;
  Mask is_anisotropic;
#endif
} Material;

static inline Material material_at(const Scene* scene, Int index) {
  Material m;
  m.phong.diffuse = MATERIAL_VEC3(scene, index, diffuse);
#if HAS_PHONG_LOBE
  m.phong.specular = MATERIAL_VEC3(scene, index, specular);
  m.phong.exponent = MATERIAL_REAL(scene, index, exponent);
  m.phong.diffuse_max = MATERIAL_REAL(scene, index, diffuse_max);
  m.phong.specular_max = MATERIAL_REAL(scene, index, specular_max);
  m.phong.table_scale = MATERIAL_REAL(scene, index, table_scale);
  m.phong.grazing_reflectivity = MATERIAL_REAL(scene, index, grazing_reflectivity);
  m.phong.table_row = MATERIAL_INT(scene, index, table_row);
  m.phong.table = scene->reflectivity;
#endif
#if HAS_ANISOTROPIC
  m.is_anisotropic = (MATERIAL_INT(scene, index, flags) & MATERIAL_ANISOTROPIC) != 0;
  m.anisotropic.diffuse = m.phong.diffuse;
  m.anisotropic.specular = MATERIAL_VEC3(scene, index, specular);
  m.anisotropic.exponent_u = MATERIAL_REAL(scene, index, exponent);
  m.anisotropic.exponent_v = MATERIAL_REAL(scene, index, exponent_v);
  m.anisotropic.diffuse_max = MATERIAL_REAL(scene, index, diffuse_max);
  m.anisotropic.specular_max = MATERIAL_REAL(scene, index, specular_max);
#endif
  return m;
}

// Lanes whose surface reflects anything on the side that was hit.
static inline Mask reflects(const Scene* scene, Int material, Mask front) {
  if (!(HAS_TWO_SIDED | HAS_BLACK)) return front;
  const Int side = front ? (Int)(MATERIAL_FRONT) : (Int)(MATERIAL_BACK);
  return (MATERIAL_INT(scene, material, flags) & side) != 0;
}

// The four functions of phong.cl, for whichever model the surface has.

static inline Vec3 material_eval(Material m, Vec3 fixed, Vec3 generated) {
  const Vec3 phong = phong_eval(m.phong, fixed, generated);
#if HAS_ANISOTROPIC
  return vec_select(m.is_anisotropic, anisotropic_eval(m.anisotropic, fixed, generated), phong);
#else
  return phong;
#endif
}

static inline Real material_density(Material m, Vec3 fixed, Vec3 generated) {
  const Real phong = phong_density(m.phong, fixed, generated);
#if HAS_ANISOTROPIC
  return m.is_anisotropic ? anisotropic_density(m.anisotropic, fixed, generated) : phong;
#else
  return phong;
#endif
}

// The lanes of `asked` whose material is a phong.
static inline Mask asked_of_phong(Material m, Mask asked) {
#if HAS_ANISOTROPIC
  return asked & !m.is_anisotropic;
#else
  return asked;
#endif
}

static inline PhongSample material_sample(Material m, Vec3 fixed, RandomSequence sequence, Uint dimension,
                                          Mask roulette, Mask asked) {
  const PhongSample phong = phong_sample(m.phong, fixed, sequence, dimension, roulette, asked_of_phong(m, asked));
#if HAS_ANISOTROPIC
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
