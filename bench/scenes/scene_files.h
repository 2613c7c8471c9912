// The scene files that are measured.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/scene.h"

namespace phlux::bench {

/// The scenes that come with Phlux: scenes/*.xml in the working directory, or else in the parent of the
/// folder that holds the program. @throws UsageError if there are none
[[nodiscard]] std::vector<std::filesystem::path> shipped_scenes();

/// The scene in `file`, with an image of `largest_side` pixels at most. @throws SceneError
[[nodiscard]] scene::Scene load_at_size(const std::filesystem::path& file, int largest_side);

/// Loads each file once, so that errors appear before anything is measured. @throws SceneError
void check_scenes(const std::vector<std::filesystem::path>& files);

} // namespace phlux::bench
