// Measures the error of float32 against float64 with the same samples, relative to their noise, and its
// speed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/options.h"

namespace phlux::bench {

/// WIDTH 1 and `lanes` are measured.
struct PrecisionOptions : CommonOptions {
  std::vector<std::filesystem::path> scenes; ///< empty: shipped_scenes() and scenes/stability
  bool quick = false;                        ///< only path tracing, only scenes/, fewer samples
  std::uint64_t seed = 1;
  std::function<bool()> interrupted; ///< may be empty
};

[[nodiscard]] const std::vector<std::string>& precision_columns();

/// Writes precision.csv, then its charts and its section of the report. Returns false if interrupted.
/// @throws UsageError, SceneError, DeviceError (also if the device has no doubles), WriteError
[[nodiscard]] bool measure_precision(const PrecisionOptions& options);

} // namespace phlux::bench
