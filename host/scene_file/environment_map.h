// <emitter type="envmap">: an image of the radiance from every direction.
#pragma once

#include "scene/scene.h"
#include "scene_file/properties.h"

namespace phlux::scene_file {

/// The map; one that is black has a scale of 0.
/// @throws SceneError for an image that cannot be read or has negative pixels, a negative scale, and a
/// transform that shears
[[nodiscard]] scene::EnvironmentMap read_environment_map(Properties& properties);

} // namespace phlux::scene_file
