// A scene of `phlux bench remedies` with any number of lights.
#pragma once

#include "scene/scene.h"

namespace phlux::bench {

/// A square floor of `lights` square metres with as many disk lights 1 m above it at random places. The disks
/// face down; their powers vary by a factor of 100. The camera in the middle sees near and distant parts of
/// the floor. The image has side x side pixels.
[[nodiscard]] scene::Scene many_lights_scene(int lights, int side);

} // namespace phlux::bench
