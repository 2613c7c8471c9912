#include "bench/common/methods/comparison.h"

#include <algorithm>

#include <fmt/format.h>

namespace phlux::bench {

SceneBenchSettings bench_settings(const ComparisonOptions& options) {
  SceneBenchSettings settings;
  options.apply_to(settings);
  settings.seed = options.seed;
  settings.interrupted = options.interrupted;
  return settings;
}

double seconds_left_for_each(const ComparisonOptions& options, double seconds, double total, double building,
                             std::size_t scenes) {
  if (options.seconds) return seconds;
  return std::clamp((total - building) / static_cast<double>(scenes), seconds / 4, seconds);
}

std::string text_of_strategies(const ComparisonOptions& options) {
  std::string text;
  if (options.strategies != ComparisonOptions().strategies)
    for (const std::string& strategy : options.strategies) text += " --strategy " + strategy;
  return text;
}

std::string text_of_amount(const ComparisonOptions& options) {
  std::string text;
  if (options.seconds) text += fmt::format(" --seconds {}", *options.seconds);
  if (options.side) text += fmt::format(" --side {}", *options.side);
  if (options.lanes != 0) text += fmt::format(" --width {}", options.lanes);
  if (options.seed != ComparisonOptions().seed) text += fmt::format(" --seed {}", options.seed);
  return text;
}

} // namespace phlux::bench
