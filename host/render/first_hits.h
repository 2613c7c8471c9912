// Renders properties of the first surface that camera rays hit.
#pragma once

#include <vector>

#include "film/first_hit.h"
#include "film/progress.h"
#include "render/render.h"

namespace phlux::render {

/// The first hits of each pixel's first samples, row by row, on the first of the settings' devices.
/// @throws SceneError and DeviceError as Renderer
[[nodiscard]] std::vector<film::FirstHit> first_hits(const scene::Scene& scene, const Settings& settings,
                                                     const film::Progress& progress = {});

inline constexpr int first_hit_samples = 16; ///< that are averaged for each pixel

} // namespace phlux::render
