// The description of a scene that `phlux info` prints.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "render/render.h"
#include "scene/scene.h"

namespace phlux::cli {

/// A scene's image, camera, shapes, materials and lights, and how the first device of `settings` would render
/// it: kernel, parts, and memory in bytes. Without a device `device` and `kernel` are null and `no_device`
/// says why. @throws UsageError and SceneError as render::Renderer
[[nodiscard]] nlohmann::ordered_json scene_json(const std::string& file, const scene::Scene& scene,
                                                const render::Settings& settings);
/// The same as lines of text.
[[nodiscard]] std::string scene_text(const nlohmann::ordered_json& scene);

} // namespace phlux::cli
