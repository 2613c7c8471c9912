// Options of measurements that compare methods, and the settings that follow from them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/methods/scene_bench.h"
#include "bench/common/options.h"

namespace phlux::bench {

struct ComparisonOptions : CommonOptions {
  std::vector<std::string> strategies = {"exact"};
  bool quick = false;            ///< fewer and shorter renders; bidir only with balance weights
  std::optional<double> seconds; ///< per scene
  std::optional<int> side;       ///< longer side of the images in pixels
  std::uint64_t seed = 1;
  bool build_ahead = false; ///< build_programs() first; only in a process that has not used OpenCL yet
  std::function<bool()> interrupted; ///< may be empty
};

[[nodiscard]] SceneBenchSettings bench_settings(const ComparisonOptions& options);

/// Seconds for each scene: the requested time if there is one. Else the `total` minus the time spent on
/// `building` kernels, divided by the number of scenes, limited to [seconds / 4, seconds].
[[nodiscard]] double seconds_left_for_each(const ComparisonOptions& options, double seconds, double total,
                                           double building, std::size_t scenes);

/// Command line text of the options that differ from their defaults, each after a space.
[[nodiscard]] std::string text_of_strategies(const ComparisonOptions& options);
[[nodiscard]] std::string text_of_amount(const ComparisonOptions& options); ///< seconds, side, WIDTH and seed

} // namespace phlux::bench
