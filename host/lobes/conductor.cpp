#include "lobes/models.h"
#include "lobes/shipped.h"

namespace phlux::lobes {
namespace {

double factor(const scene::Material& m) {
  return largest_channel(m.value("specular_reflectance"));
}

// Without a real part of its index of refraction, a conductor reflects everything.
scene::Material without_fresnel(const scene::Material& m) {
  if (m.value("eta") != scene::Rgb(0.0)) return m;
  scene::Material material = mirror(scene::Rgb(1.0));
  material.take("specular_reflectance", m, "specular_reflectance");
  return material;
}

} // namespace

const ShippedModel roughconductor_model{"roughconductor", "lobes/roughconductor.cl", factor};
const ShippedModel anisotropicconductor_model{"anisotropicconductor", "lobes/anisotropicconductor.cl",
                                              factor};
const ShippedModel conductor_model{"conductor", "lobes/conductor.cl", factor, nullptr, without_fresnel};

} // namespace phlux::lobes
