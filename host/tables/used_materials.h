// The materials of a scene's primitives.
#pragma once

#include <vector>

#include "accel/geometry.h"
#include "scene/scene.h"

namespace phlux::tables {

/// Without materials of the scene that no primitive has.
[[nodiscard]] std::vector<scene::Material> used_materials(const scene::Scene& scene,
                                                          const accel::Geometry& geometry);

} // namespace phlux::tables
