// The size of a scene's image.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace phlux::scene {

/// Scales an image down so that its longer side has at most `longest_side` pixels; keeps its aspect ratio, up
/// to rounding.
inline void shrink_image(Camera& camera, int longest_side) {
  const int side = std::max(camera.width, camera.height);
  if (side <= longest_side) return;
  const auto scaled = [&](int pixels) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(pixels) * longest_side / side)));
  };
  camera.width = scaled(camera.width);
  camera.height = scaled(camera.height);
}

} // namespace phlux::scene
