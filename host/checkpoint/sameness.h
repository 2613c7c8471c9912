// Checks that a checkpoint belongs to the render that resumes from it.
#pragma once

#include <filesystem>

#include "checkpoint/checkpoint.h"

namespace phlux::checkpoint {

/// A scene's digest, followed by that of the kernel file if the strategy is one of the user's own.
/// @throws UsageError when the file cannot be read
[[nodiscard]] std::string digest_with_strategy(const std::string& scene_digest,
                                               const render::Settings& settings);
/// The scene's digest in one with that of a strategy.
[[nodiscard]] std::string scene_part(const std::string& digest);

/// Compares what determines the image: its size, the scene and the settings; and checks every number of the
/// state against them. `file` is the checkpoint's name; width and height are those of `now`.
/// @throws FileError for a difference or a state that such a render cannot have had, UsageError for a
/// checkpoint with more samples than `now` asks for
void check_same(const Checkpoint& earlier, const Session& now, int width, int height,
                const std::filesystem::path& file);

} // namespace phlux::checkpoint
