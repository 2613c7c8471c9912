// The share of each light of a scene in the variance.
#pragma once

#include <string>
#include <vector>

#include "render/render.h"

namespace phlux::advice {

struct LightShare {
  std::string light;  ///< such as "area light 2": the second one in the scene file
  double share = 0.0; ///< in the variance of a sample, summed over the image
};

/// Scenes with more lights would take too many renders.
inline constexpr std::size_t most_lights = 8;

/// The number of renders of light_shares(): one for each light; 0 for a single light or more than
/// most_lights.
[[nodiscard]] std::size_t light_share_renders(const scene::Scene& scene);

/// Renders each light alone by these settings, for their time_limit. Radiance is additive over lights, and
/// variance nearly so. The scene is unchanged afterwards. @throws UsageError, DeviceError
[[nodiscard]] std::vector<LightShare> light_shares(scene::Scene& scene, const render::Settings& settings,
                                                   const render::Events& events = {});

} // namespace phlux::advice
