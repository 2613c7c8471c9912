// The materials that a scene's primitives have.
#pragma once

#include <vector>

#include "accel/geometry.h"
#include "scene/scene.h"

namespace phlux::tables {

/// Those that some primitive has; a scene may define others.
[[nodiscard]] std::vector<scene::Material> used_materials(const scene::Scene& scene,
                                                          const accel::Geometry& geometry);

} // namespace phlux::tables
