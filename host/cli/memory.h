// The memory that a render needs, and what there is.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/outputs.h"
#include "film/paged_array.h"
#include "scene/scene.h"
#include "settings/settings.h"

namespace phlux::cli {

/// Bytes that a render takes for its film and for writing it, beside at most a gigabyte that does not depend
/// on the number of pixels.
struct MemoryNeed {
  double memory = 0.0;
  double in_file = 0.0; ///< of these, what film::Storage::file moves to a file
};
[[nodiscard]] MemoryNeed memory_needed(double pixels, const settings::Settings& settings,
                                       const Outputs& outputs);

/// Bytes that this process can still take: free memory of the machine and of its control group, and the limit
/// on its address space. Nothing if the system does not say.
[[nodiscard]] std::optional<double> memory_available();

/// Where the film of a render is to be: in memory if it needs at most `most` bytes (by default those
/// available), else with its sums of samples in a file, which a warning says. To be called before anything is
/// rendered. @throws UsageError with what is needed if neither has the room
[[nodiscard]] film::Storage storage_for(const scene::Camera& camera, const settings::Settings& settings,
                                        const Outputs& outputs, std::optional<double> most);

/// The same for the film of a checkpoint, by the size of its file; whether there is room turns out later.
[[nodiscard]] film::Storage storage_for(const std::filesystem::path& checkpoint, std::optional<double> most);

} // namespace phlux::cli
