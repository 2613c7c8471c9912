// Every light of a scene in one table, with the probability of choosing it.
#pragma once

#include <vector>

#include "accel/geometry.h"
#include "scene/scene.h"
#include "scene_data.h"

namespace phlux::render {

struct LightTable {
  std::vector<LightRecord> records;
  int constant = -1; ///< index of the constant light
  [[nodiscard]] bool has(LightKinds kind) const;
};

/// One record per emitting primitive and per light without surface, chosen half in proportion to the power
/// that it sends into the scene and half evenly over the emitters. Sets the `light` of the geometry's
/// primitives. Lights without power are never chosen.
[[nodiscard]] LightTable light_table(const scene::Scene& scene, accel::Geometry& geometry);

} // namespace phlux::render
