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

[[nodiscard]] inline bool is_within(const Window& window, const Camera& camera) {
  return window.x >= 0 && window.y >= 0 && window.width >= 1 && window.height >= 1 &&
         window.width <= camera.width - window.x && window.height <= camera.height - window.y;
}

/// Makes a part of the camera's image, within it, the whole: the same pixels, of the same directions.
inline void crop_image(Camera& camera, const Window& window) {
  const double across = static_cast<double>(window.width) / camera.width,
               down = static_cast<double>(window.height) / camera.height;
  camera.principal_x = ((window.x + 0.5 * window.width) / camera.width - 0.5 + camera.principal_x) / across;
  camera.principal_y = ((window.y + 0.5 * window.height) / camera.height - 0.5 + camera.principal_y) / down;
  camera.tan_half_fov_x *= across;
  camera.origin = {window.x, window.y};
  camera.whole = {camera.width, camera.height};
  camera.width = window.width;
  camera.height = window.height;
}

} // namespace phlux::scene
