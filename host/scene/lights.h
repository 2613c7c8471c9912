// Properties of the lights of a scene.
#pragma once

#include "scene/scene.h"

namespace phlux::scene {

/// Whether some lights have no extent, so that no ray hits them.
[[nodiscard]] inline bool has_unhittable_lights(const Scene& scene) {
  return !scene.point_lights.empty() || !scene.spot_lights.empty() || !scene.directional_lights.empty();
}

} // namespace phlux::scene
