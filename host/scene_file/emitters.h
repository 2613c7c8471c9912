// <emitter>: area (inside a shape), point, spot, directional, constant.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// Adds the emitter to the scene's list of its type; one that emits nothing is left out with a warning.
/// @throws SceneError for negative values and unsupported types or properties
void read_emitter(const Element& emitter, const Document& document, scene::Scene& scene);

/// The radiance of <emitter type="area">. @throws SceneError, also for any other type
[[nodiscard]] scene::AreaEmitter read_area_emitter(const Element& emitter, const Document& document);

} // namespace phlux::scene_file
