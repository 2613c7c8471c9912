// The scene of `phlux bench stability`: one room whose glossy panels and lamp have parameters.
#pragma once

#include "scene/scene.h"

namespace phlux::bench {

inline constexpr double largest_light_radius = 0.3; ///< a larger lamp would come into view

/// An open box with edges of 2, lit from beside the camera by a disk of `light_radius` (above 0, at most
/// largest_light_radius) whose power does not depend on it. Two panels have a lobe of `exponent`: one on the
/// floor throws a caustic on the walls above, and shows the camera a part of the back wall where that
/// caustic is not; one on the left shows it the lamp's highlight. So every path of light has an efficient
/// technique, however small the lamp and however sharp the lobe. `side` pixels, square.
[[nodiscard]] scene::Scene stability_scene(double exponent, double light_radius, int side);

} // namespace phlux::bench
