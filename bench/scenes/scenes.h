// Every method on every scene: variance, time, their product, convergence against a reference, charts and a
// report.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/common/methods/comparison.h"
#include "scene/scene.h"

namespace phlux::bench {

/// Absent seconds: what keeps all within 17 minutes, or 90 s when quick. Absent side: 128, or 64.
struct ScenesOptions : ComparisonOptions {
  std::vector<std::filesystem::path> scenes; ///< empty: those that ship with phlux
};

/// Writes scenes.csv (the columns of the contract, then those that say how they were measured), the doubling
/// times in scenes-convergence.csv, the references and images, then charts and the report. Rows that the
/// folder has of the same settings are kept, so that an interrupted run goes on where it was stopped, at the
/// scene.
/// Returns false when interrupted. @throws UsageError, SceneError, DeviceError, WriteError
[[nodiscard]] bool measure_scenes(const ScenesOptions& options);

/// The scene in `file`, its image no larger than `largest_side` pixels. @throws SceneError
[[nodiscard]] scene::Scene load_at_size(const std::filesystem::path& file, int largest_side);

/// The scenes that ship: scenes/*.xml in the working directory, or beside the program's folder. @throws
/// UsageError where there are none
[[nodiscard]] std::vector<std::filesystem::path> shipped_scenes();

} // namespace phlux::bench
