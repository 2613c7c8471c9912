// Every sampling strategy over materials and angles: mean, variance, rays and time of one sample.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/options.h"
#include "bench/sampling/sampler.h"

namespace phlux::bench {

struct SamplingOptions : CommonOptions {
  std::vector<std::string> strategies;  ///< empty: all
  std::vector<Case> cases;              ///< empty: the grid
  std::vector<Light> lights;            ///< empty: all
  bool quick = false;                   ///< a grid of thirteen cases
  bool fresh = false;                   ///< forget what an earlier run left in the folder
  std::optional<std::uint64_t> samples; ///< per row; absent: 2^19, 2^18 when quick, fewer where a sample
                                        ///< costs much
  std::uint32_t seed = 1;
  std::function<bool()> interrupted; ///< asked after each case
};

/// Above so many proposals for a sample `rejection` is left out.
inline constexpr double most_proposals = 1000;

/// The cases of MATH.md 2.6, whose variances are known by quadrature, then a grid over material, exponent and
/// angle.
[[nodiscard]] std::vector<Case> sampling_cases(bool quick);

/// Measures and writes to the folder as it goes: sampling.csv, where strategies absorb by roulette if that is
/// how they work, and sampling-no-roulette.csv, where those do not. Strategies take turns, so that they share
/// what else the machine does. Goes on where a run with the same settings was stopped. Returns whether it
/// came to its end. @throws UsageError, DeviceError, WriteError
[[nodiscard]] bool write_sampling_tables(const SamplingOptions& options);

/// The tables, a summary on standard output, and the charts and section of the report. @throws as the above;
/// WriteError also when the charts cannot be drawn: the tables are there then
[[nodiscard]] bool measure_sampling(const SamplingOptions& options);

} // namespace phlux::bench
