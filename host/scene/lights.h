// Properties of the lights of a scene.
#pragma once

#include "scene/scene.h"

namespace phlux::scene {

/// Whether some lights have no extent, so that no ray hits them.
[[nodiscard]] inline bool has_unhittable_lights(const Scene& scene) {
  return !scene.point_lights.empty() || !scene.spot_lights.empty() || !scene.directional_lights.empty();
}

/// Whether no path from the eye carries the light that point, spot and directional lights send through
/// mirrors and smooth glass.
[[nodiscard]] inline bool eye_paths_miss_light(const Scene& scene) {
  return has_delta(scene) && has_unhittable_lights(scene);
}

} // namespace phlux::scene
