// Directions and colours in float64, as host code knows them.
#pragma once

#include <glm/vec3.hpp>

namespace phlux::measure {

using Direction = glm::dvec3; ///< in a frame whose z is the surface normal; of unit length or nearly so
using Rgb = glm::dvec3;

} // namespace phlux::measure
