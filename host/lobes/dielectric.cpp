#include <algorithm>
#include <cmath>

#include "lobes/models.h"
#include "lobes/shipped.h"

namespace phlux::lobes {
namespace {

// Reflectance and transmittance add up to at most the larger of their factors.
double larger_factor(const scene::Material& m) {
  return std::max(largest_channel(m.value("specular_reflectance")),
                  largest_channel(m.value("specular_transmittance")));
}

// Between equal indices facets refract nothing, and those of refraction have no half vector: the surface is
// as a smooth one.
scene::Material without_facets(const scene::Material& m) {
  const double inside = m.value("int_ior").x, outside = m.value("ext_ior").x;
  if (std::abs(inside / outside - 1.0) > 2e-6) return m; // beyond single precision's error in half vectors
  scene::Material material = dielectric(inside);
  for (const char* name : {"int_ior", "ext_ior", "specular_reflectance", "specular_transmittance"})
    material.take(name, m, name);
  return material;
}

} // namespace

const ShippedModel dielectric_model{"dielectric", "lobes/dielectric.cl", larger_factor};
const ShippedModel thindielectric_model{"thindielectric", "lobes/thindielectric.cl", larger_factor};
const ShippedModel roughdielectric_model{"roughdielectric", "lobes/roughdielectric.cl", larger_factor,
                                         nullptr, without_facets};
const ShippedModel anisotropicdielectric_model{"anisotropicdielectric", "lobes/anisotropicdielectric.cl",
                                               larger_factor, nullptr, without_facets};

} // namespace phlux::lobes
