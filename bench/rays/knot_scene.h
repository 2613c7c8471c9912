// A scene of a chosen number of triangles: a bumpy torus knot in a closed room.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace phlux::bench {

/// About `triangles` triangles (36 or more), twelve of them the walls of the room.
[[nodiscard]] scene::Scene knot_scene(std::uint64_t triangles);

} // namespace phlux::bench
