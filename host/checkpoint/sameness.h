// Checks that a checkpoint belongs to the render that resumes from it.
#pragma once

#include <filesystem>

#include "checkpoint/checkpoint.h"

namespace phlux::checkpoint {

/// Compares what determines the image: its size, the scene and the settings; and checks every number of the
/// state against them. `file` is the checkpoint's name; width and height are those of `now`.
/// @throws FileError for a difference or a state that such a render cannot have had, UsageError for a
/// checkpoint with more samples than `now` asks for
void check_same(const Checkpoint& earlier, const Session& now, int width, int height,
                const std::filesystem::path& file);

} // namespace phlux::checkpoint
