// A table of all lights of a scene, with their probabilities for light paths and for light samples.
#pragma once

#include <vector>

#include "accel/geometry.h"
#include "scene/scene.h"
#include "scene/scene_data.h"
#include "settings/settings.h"
#include "tables/environment_table.h"

namespace phlux::tables {

struct LightTable {
  std::vector<LightRecord> records;
  std::vector<LightNodeRecord> nodes; ///< the tree of the lights with bounds; empty for fewer than two
  double tree_probability = 0.0;      ///< with which a light sample chooses one of those lights by power
  int sky = -1; ///< index of the constant light or the environment map, which is the last; -1: none
  EnvironmentTable environment; ///< of the map
  double unit = 1.0;            ///< the radiance that is 1 in the records, a power of two
  [[nodiscard]] bool has(LightKinds kind) const;
  [[nodiscard]] bool shines() const;      ///< whether a light has power
  [[nodiscard]] bool samples_sky() const; ///< whether light samples may choose the sky
};

/// One record per emitting primitive and per light without surface. Half of the selections are in proportion
/// to the power that a light sends into the scene, half uniform over the emitters; lights without power are
/// never chosen. Where scattered rays find light too, light samples choose a constant sky only if there is no
/// other light. For selection by contribution, the table has a tree of the lights with bounds. Sets the
/// `light` of the geometry's primitives. The unit is 1 unless squares of the lights' radiance could leave the
/// range of float.
[[nodiscard]] LightTable light_table(const scene::Scene& scene, accel::Geometry& geometry,
                                     const settings::Settings& settings);

} // namespace phlux::tables
