#include "lobes/shipped.h"

namespace phlux::lobes {

const ShippedModel mirror_model{"mirror", "lobes/mirror.cl", [](const scene::Material& m) {
                                  return static_cast<double>(
                                      largest_channel(m.value("specular_reflectance")));
                                }};

} // namespace phlux::lobes
