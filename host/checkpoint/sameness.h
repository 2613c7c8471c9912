// Whether a checkpoint is of the render that is to go on.
#pragma once

#include <filesystem>

#include "checkpoint/checkpoint.h"

namespace phlux::checkpoint {

/// Looks at what decides the image: its size, the scene, the settings; and whether there are more samples
/// than are wanted. `file` is the checkpoint's name, width and height those of `now`.
/// @throws FileError or UsageError, naming what differs and what would be right
void check_same(const Checkpoint& earlier, const Session& now, int width, int height,
                const std::filesystem::path& file);

} // namespace phlux::checkpoint
