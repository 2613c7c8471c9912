// Measures techniques that reduce variance without bias: renders with and without each one alternate.
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
  bool quick = false;                ///< fewer and easier scenes, shorter renders
  std::uint64_t seed = 1;
  std::function<bool()> interrupted; ///< may be empty
};

/// "light-selection", "connections", "exact-lobe".
[[nodiscard]] const std::vector<std::string>& remedy_names();

/// One remedy, scene and method. The settings before and after differ only in the remedy.
struct RemedyCase {
  std::string remedy, place;
  scene::Scene scene;
  Method method;
  render::Settings before, after;
};

[[nodiscard]] std::vector<RemedyCase> remedy_cases(const RemediesOptions& options);

/// Variance and cost of a sample.
struct Efficiency {
  Estimate variance; ///< relative
  double seconds_per_sample = 0, rays_per_sample = 0;
};

/// Gain in efficiency: (variance x seconds) before / after. Its standard error is from those of the
/// variances.
[[nodiscard]] Estimate gain_of(const Efficiency& before, const Efficiency& after);

/// Writes remedies.csv (bench/README.md), then its chart and its section of the report. Returns false if
/// interrupted. @throws UsageError, DeviceError, WriteError
[[nodiscard]] bool measure_remedies(const RemediesOptions& options);

} // namespace phlux::bench
