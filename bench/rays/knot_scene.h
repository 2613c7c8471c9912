// A scene of a chosen number of triangles: a bumpy torus knot in a closed room.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace phlux::bench {

/// About `triangles` triangles (at least 36), twelve of them the room's walls.
[[nodiscard]] scene::Scene knot_scene(std::uint64_t triangles);

} // namespace phlux::bench
