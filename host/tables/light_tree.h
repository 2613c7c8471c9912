// The tree of lights from which light samples choose by what a light is likely to bring
// (kernels/scene/light_tree.cl).
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::tables {

/// What bounds the light that one light sends.
struct PlacedLight {
  int light;             ///< index of its record
  scene::Vec3 low, high; ///< corners of a box that holds it, about the geometry's origin
  scene::Vec3 axis;      ///< unit, of a cone that holds its normals, or the directions of a spot light's beam
  double spread;         ///< half the cone's angle in radians; pi: any direction
  double intensity;      ///< the most that it sends in any direction, W / sr, > 0
};

/// The nodes, and each record's leaf in `records`. Empty for fewer than two lights, which leave no choice.
/// @throws SceneError when there is no memory for it
[[nodiscard]] std::vector<LightNodeRecord> light_tree(std::span<const PlacedLight> lights,
                                                      std::vector<LightRecord>& records);

} // namespace phlux::tables
