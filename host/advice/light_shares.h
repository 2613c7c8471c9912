// Which of a scene's lights a method finds hard.
#pragma once

#include <string>
#include <vector>

#include "render/render.h"

namespace phlux::advice {

struct LightShare {
  std::string light;  ///< such as "area light 2": the second one in the scene file
  double share = 0.0; ///< in the variance of a sample, summed over the image
};

/// Scenes with more lights are not asked: each takes a render of its own.
inline constexpr std::size_t most_lights_told_apart = 8;

/// How many renders light_shares() takes: one for each light, none where there is one light or too many.
[[nodiscard]] std::size_t lights_told_apart(const scene::Scene& scene);

/// Renders each light alone by these settings, for their time_limit. What the lights bring adds up, and their
/// variances nearly do. The scene comes back as it was. @throws UsageError, DeviceError
[[nodiscard]] std::vector<LightShare> light_shares(scene::Scene& scene, const render::Settings& settings);

} // namespace phlux::advice
