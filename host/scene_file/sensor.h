// <sensor type="perspective"> with its film and sampler.
#pragma once

#include <array>
#include <optional>

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// Camera, image size (`size` in place of the film's) and samples per pixel. @throws SceneError
void read_sensor(const Element& sensor, const Document& document,
                 const std::optional<std::array<int, 2>>& size, scene::Scene& scene);

} // namespace phlux::scene_file
