// The scene of `phlux bench stability`: a room with variable lobe exponent and light size.
#pragma once

#include "scene/scene.h"

namespace phlux::bench {

inline constexpr double largest_light_radius = 0.3; ///< a larger light would be visible

/// An open box of edge length 2, lit from beside the camera by a disk of radius `light_radius` (above 0, at
/// most largest_light_radius). The power of the disk is the same for every radius. Two panels have a Phong
/// lobe of this exponent. The one on the floor casts a caustic on the walls above it, and reflects to the
/// camera a part of the back wall outside that caustic; the one on the left reflects the light to the camera.
/// Hence each kind of path has an efficient bidirectional technique, however small the light and however
/// narrow the lobe. The image has side x side pixels.
[[nodiscard]] scene::Scene stability_scene(double exponent, double light_radius, int side);

} // namespace phlux::bench
