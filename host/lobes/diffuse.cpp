#include "lobes/shipped.h"

namespace phlux::lobes {

const ShippedModel diffuse_model{"diffuse", "lobes/diffuse.cl", [](const scene::Material& m) {
                                   return static_cast<double>(largest_channel(m.value("reflectance")));
                                 }};

} // namespace phlux::lobes
