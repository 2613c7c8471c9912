// What lessens variance where methods fail, without a bias: each remedy before and after, in turns.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/methods/method.h"
#include "bench/common/options.h"

namespace phlux::bench {

struct RemediesOptions : CommonOptions {
  std::vector<std::string> remedies; ///< of remedy_names(); empty: all
  bool quick = false;                ///< fewer and easier places, shorter renders
  std::uint64_t seed = 1;
  std::function<bool()> interrupted; ///< may be empty
};

/// "light-selection", "connections", "exact-lobe".
[[nodiscard]] const std::vector<std::string>& remedy_names();

/// One method at one place with one remedy: settings that differ in nothing else.
struct RemedyCase {
  std::string remedy, place;
  scene::Scene scene;
  Method method;
  render::Settings before, after;
};

[[nodiscard]] std::vector<RemedyCase> remedy_cases(const RemediesOptions& options);

struct Efficiency {
  Figure variance; ///< per sample, relative
  double seconds_per_sample = 0, rays_per_sample = 0;
};

/// How many times as much is had of a second: (variance x seconds) before / after, and its standard error.
[[nodiscard]] Figure gain_of(const Efficiency& before, const Efficiency& after);

/// Measures and writes remedies.csv (README.md) as it goes, then its chart and its section of the report.
/// Returns false when interrupted. @throws UsageError, DeviceError, WriteError
[[nodiscard]] bool measure_remedies(const RemediesOptions& options);

} // namespace phlux::bench
