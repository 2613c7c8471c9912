// The memory that a render needs, and what there is.
#pragma once

#include <optional>

#include "cli/outputs.h"
#include "scene/scene.h"
#include "settings/settings.h"

namespace phlux::cli {

/// Bytes that a render takes for its film and for writing it, beside at most a gigabyte that does not depend
/// on the number of pixels.
[[nodiscard]] double memory_needed(double pixels, const settings::Settings& settings, const Outputs& outputs);

/// Bytes that this process can still take: free memory of the machine and of its control group, and the limit
/// on its address space. Nothing if the system does not say.
[[nodiscard]] std::optional<double> memory_available();

/// Before anything is rendered. @throws UsageError with what is needed if there is less
void require_memory(const scene::Camera& camera, const settings::Settings& settings, const Outputs& outputs);

} // namespace phlux::cli
