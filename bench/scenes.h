// Every method on every scene: variance, time, their product, convergence against a reference, charts and a
// report.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace phlux::bench {

struct ScenesOptions {
  std::filesystem::path folder;
  std::vector<std::string> devices;          ///< --device specifications; the first one is measured
  int lanes = 0;                             ///< WIDTH; 0: what suits the device
  std::filesystem::path kernel_dir;          ///< empty: the embedded kernels
  std::vector<std::filesystem::path> scenes; ///< empty: those that ship with phlux
  std::vector<std::string> strategies = {"exact"};
  bool quick = false;              ///< fewer and shorter renders, and of bidir's weights balance alone
  std::optional<double> seconds;   ///< for each scene; absent: what keeps all within 17 minutes, or 90 s
  std::optional<int> largest_side; ///< pixels; absent: 128, 64 when quick
  std::uint64_t seed = 1;
  bool build_ahead = false;          ///< on all processors; only in a process that has not used OpenCL yet
  std::function<bool()> interrupted; ///< may be empty
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
