// What measurements that compare methods share: their options, and what follows from those.
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
  bool quick = false;            ///< fewer and shorter renders, and of bidir's weights balance alone
  std::optional<double> seconds; ///< for each scene
  std::optional<int> side;       ///< pixels of an image's longer side
  std::uint64_t seed = 1;
  bool build_ahead = false;          ///< on all processors; only in a process that has not used OpenCL yet
  std::function<bool()> interrupted; ///< may be empty
};

[[nodiscard]] SceneBenchSettings bench_settings(const ComparisonOptions& options, int trial_renders);

/// Asked for a time, scenes get it; else what building kernels left of `total` seconds for all of them, but
/// at least a quarter of `seconds` and at most those.
[[nodiscard]] double seconds_left_for_each(const ComparisonOptions& options, double seconds, double total,
                                           double building, std::size_t scenes);

/// The options as the command line takes them, each with a space before it; nothing of those at their
/// defaults.
[[nodiscard]] std::string text_of_strategies(const ComparisonOptions& options);
[[nodiscard]] std::string text_of_amount(const ComparisonOptions& options); ///< time, pixels, WIDTH and seed

} // namespace phlux::bench
