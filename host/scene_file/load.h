// Mitsuba scene files (versions 0.5, 0.6 and the 2.x and 3.x spelling) to scenes.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "lobes/models.h"
#include "scene/scene.h"

namespace phlux::scene_file {

/// Reads FILE and the meshes that it names. `definitions` are `-D name=value`, replacing `$name` and
/// <default>s; `size` is the image's width and height in pixels in place of the film's; `library`
/// has the reflectance models that the file may name. Warnings go to the
/// log (spdlog), each naming FILE:LINE.
/// @throws SceneError "FILE:LINE: what is wrong: what would be right"
[[nodiscard]] scene::Scene load(const std::filesystem::path& file,
                                const std::map<std::string, std::string>& definitions = {},
                                const std::optional<std::array<int, 2>>& size = {},
                                const lobes::Library& library = {});

} // namespace phlux::scene_file
