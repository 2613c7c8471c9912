// Measures every method on every scene: variance, time, their product, and convergence to a reference.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/common/methods/comparison.h"

namespace phlux::bench {

/// Default of seconds: 120, or 11 if quick, but 17 minutes, or 90 s, for all scenes at most. Default of side:
/// 128, or 64 if quick.
struct ScenesOptions : ComparisonOptions {
  std::vector<std::filesystem::path> scenes; ///< empty: shipped_scenes()
};

/// Writes scenes.csv (the fixed columns, then those about the measurement), scenes-convergence.csv
/// (errors at doubling times), references and images, then charts and the report. Keeps the rows that an
/// earlier run with the same settings left in the folder; resumes an interrupted run at its scene. Returns
/// false if interrupted. @throws UsageError, SceneError, DeviceError, WriteError
[[nodiscard]] bool measure_scenes(const ScenesOptions& options);

} // namespace phlux::bench
