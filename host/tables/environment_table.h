// The tables of an environment map (kernels/scene/environment.cl).
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::tables {

struct EnvironmentTable {
  EnvironmentRecord record{};
  std::vector<EnvironmentTexel> texels; ///< empty without a map
  scene::Rgb largest{0.0};              ///< radiance of a texel, by channel
  double integral = 0.0;                ///< of the radiance's mean over the channels over all directions

  /// Expresses radiance in units of `unit`.
  void use_unit(double unit);
};

[[nodiscard]] EnvironmentTable environment_table(const scene::EnvironmentMap& map);

} // namespace phlux::tables
