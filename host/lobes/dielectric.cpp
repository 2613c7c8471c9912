#include <algorithm>

#include "lobes/shipped.h"

namespace phlux::lobes {
namespace {

// Reflectance and transmittance add up to at most the larger of their factors.
double largest_reflectance(const scene::Material& m) {
  return std::max(largest_channel(m.value("specular_reflectance")),
                  largest_channel(m.value("specular_transmittance")));
}

} // namespace

const ShippedModel dielectric_model{"dielectric", "lobes/dielectric.cl", largest_reflectance};
const ShippedModel thindielectric_model{"thindielectric", "lobes/thindielectric.cl", largest_reflectance};
const ShippedModel roughdielectric_model{"roughdielectric", "lobes/roughdielectric.cl", largest_reflectance};
const ShippedModel anisotropicdielectric_model{"anisotropicdielectric", "lobes/anisotropicdielectric.cl",
                                               largest_reflectance};

} // namespace phlux::lobes
