// Every light of a scene in one table, with the probability of choosing it.
#pragma once

#include <vector>

#include "accel/geometry.h"
#include "scene/scene.h"
#include "scene/scene_data.h"

namespace phlux::tables {

struct LightTable {
  std::vector<LightRecord> records;
  std::vector<LightNodeRecord> nodes; ///< the tree of the lights that have a place; empty for fewer than two
  double tree_probability = 0.0;      ///< of choosing one of those lights
  int constant = -1;                  ///< index of the constant light
  double unit = 1.0;                  ///< the radiance that stands as 1 in the records, a power of two
  [[nodiscard]] bool has(LightKinds kind) const;
  [[nodiscard]] bool shines() const; ///< some light has power
};

/// One record per emitting primitive and per light without surface, chosen half in proportion to the power
/// that it sends into the scene and half evenly over the emitters, and a tree for choosing among those that
/// have a place by what they bring to a point. Sets the `light` of the geometry's
/// primitives. Lights without power are never chosen. Where lights are so bright or so dim that squares of
/// their radiance would not fit float, the records' `power` is in a unit near it; else the unit is 1.
[[nodiscard]] LightTable light_table(const scene::Scene& scene, accel::Geometry& geometry,
                                     bool with_tree = true);

} // namespace phlux::tables
