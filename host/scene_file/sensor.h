// <sensor type="perspective"> with its film and sampler, and <integrator>.
#pragma once

#include <array>
#include <optional>

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// Camera, image size (`size` in place of the film's) and samples per pixel. @throws SceneError
void read_sensor(const Element& sensor, const Document& document,
                 const std::optional<std::array<int, 2>>& size, scene::Scene& scene);

/// The scene's integrator, max_depth and rr_depth. @throws SceneError
void read_integrator(const Element& integrator, const Document& document, scene::RenderDefaults& defaults);

} // namespace phlux::scene_file
