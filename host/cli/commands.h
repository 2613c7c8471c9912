// What each command does. All return the exit code and throw phlux::Error for what ends them early.
#pragma once

#include "cli/options.h"

namespace phlux::cli {

/// 0, or 130 when SIGINT or SIGTERM ended it; then the files hold the image so far.
[[nodiscard]] int render(const RenderOptions& options);

/// 0.
[[nodiscard]] int list_devices(const DevicesOptions& options);

/// 0 whatever the figures, 1 when an image has values that are not finite: the figures then leave pixels out,
/// and an image that cannot be compared in full should fail a check.
[[nodiscard]] int compare(const CompareOptions& options);

/// 0.
[[nodiscard]] int merge(const MergeOptions& options);

/// 0, or 1 when a check failed; then histograms of what failed are in the working directory.
[[nodiscard]] int verify(const VerifyOptions& options);

} // namespace phlux::cli
