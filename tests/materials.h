// The parameters of phong-like materials by their usual names, for every model that has them.
#pragma once

#include "lobes/models.h"

namespace phlux::test {

inline scene::Rgb diffuse_of(const scene::Material& m) {
  return m.value(m.model == lobes::shipped("diffuse") ? "reflectance" : "diffuse_reflectance");
}
inline scene::Rgb specular_of(const scene::Material& m) {
  return m.model == lobes::shipped("diffuse") ? scene::Rgb(0.0) : m.value("specular_reflectance");
}
/// Exponent of a phong; of an anisotropic phong, that along the first tangent.
inline double exponent_of(const scene::Material& m) {
  if (m.model == lobes::shipped("diffuse")) return 0;
  return m.value(m.model == lobes::shipped("phong") ? "exponent" : "exponent_u").x;
}
inline double exponent_v_of(const scene::Material& m) {
  return m.value("exponent_v").x;
}

} // namespace phlux::test
