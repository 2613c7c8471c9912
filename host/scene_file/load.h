// Reads Mitsuba scene files (versions 0.4 to 0.6, 2.x and 3.x).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "lobes/models.h"
#include "scene/scene.h"

namespace phlux::scene_file {

/// Reads FILE and its meshes. `definitions` are values for `$name`, which override <default>s; `size`, if
/// given, is the image's width and height in pixels instead of the film's; `library` has the reflectance
/// models. Warnings are logged (spdlog) with FILE:LINE.
/// @throws SceneError "FILE:LINE: what is wrong: what would be right", for all that is wrong with the scene
/// at once; mesh files are read if nothing is
[[nodiscard]] scene::Scene load(const std::filesystem::path& file,
                                const std::map<std::string, std::string>& definitions = {},
                                const std::optional<std::array<int, 2>>& size = {},
                                const lobes::Library& library = {});

} // namespace phlux::scene_file
