#include "lobes/shipped.h"

namespace phlux::lobes {

const ShippedModel conductor_model{"conductor", "lobes/conductor.cl", [](const scene::Material& m) {
                                     return static_cast<double>(
                                         largest_channel(m.value("specular_reflectance")));
                                   }};

} // namespace phlux::lobes
