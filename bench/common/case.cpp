#include "bench/common/case.h"

#include <cmath>
#include <numbers>

#include "phong/reflectivity.h"

namespace phlux::bench {

double exact_reflectivity(const Case& one) {
  const double cosine = std::cos(one.degrees * std::numbers::pi / 180);
  return one.diffuse + one.specular * phong::lobe_reflectivity(one.exponent, cosine);
}

scene::Material material_of(const Case& one) {
  if (one.given) return *one.given;
  return lobes::phong(scene::Rgb(one.diffuse), scene::Rgb(one.specular), one.exponent);
}

} // namespace phlux::bench
