// The tree by which light samples choose lights by contribution (kernels/scene/light_tree.cl).
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::tables {

/// Bounds of a light's position, directions and intensity.
struct LightBounds {
  int light;             ///< index of its record
  scene::Vec3 low, high; ///< corners of its bounding box, relative to the geometry's origin
  scene::Vec3 axis;      ///< unit, of a bounding cone of its normals, or of the directions of a spot light
  double spread;         ///< half the cone's angle in radians; pi: any direction
  double intensity;      ///< largest over all directions, W / sr, > 0
};

/// The nodes; sets each record's leaf, `node`. Empty for fewer than two lights.
/// @throws SceneError for too little memory
[[nodiscard]] std::vector<LightNodeRecord> light_tree(std::span<const LightBounds> lights,
                                                      std::vector<LightRecord>& records);

} // namespace phlux::tables
