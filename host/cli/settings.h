// From what the user and the scene say to what is rendered.
#pragma once

#include "cli/options.h"
#include "scene/scene.h"

namespace phlux::cli {

/// @throws UsageError for options that do not go together
[[nodiscard]] settings::Settings settings_of(const RenderOptions& options,
                                             const scene::RenderDefaults& defaults);

} // namespace phlux::cli
