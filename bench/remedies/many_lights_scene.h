// A scene of `phlux bench remedies`: as many lights as one likes.
#pragma once

#include "scene/scene.h"

namespace phlux::bench {

/// A square of floor with so many lamps a metre above it, one for each square metre: disks that face down,
/// of 1 to 100 times the least power. The camera stands in the middle and sees what is near and what is far
/// away. `side` pixels, square.
[[nodiscard]] scene::Scene many_lights_scene(int lights, int side);

} // namespace phlux::bench
