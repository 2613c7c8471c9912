// Every sampling strategy over materials and angles: mean, variance, rays and time of one sample.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/sampler.h"

namespace phlux::bench {

struct SamplingOptions {
  std::filesystem::path folder;        ///< of sampling.csv
  std::vector<std::string> devices;    ///< --device specifications; the first one is measured
  int lanes = 0;                       ///< WIDTH; 0: what suits the device
  std::filesystem::path kernel_dir;    ///< empty: the embedded kernels
  std::vector<std::string> strategies; ///< empty: all
  std::vector<Case> cases;             ///< empty: the grid
  bool quick = false;                  ///< a grid of ten cases
  std::optional<std::uint64_t>
      samples; ///< per row; absent: 2^22, 2^20 when quick, fewer where a sample costs much
  std::uint32_t seed = 1;
};

/// Above so many proposals for a sample `rejection` is left out.
inline constexpr double most_proposals = 1e4;

/// The columns of the contract, then those that say how they were measured.
extern const char* const sampling_columns;

/// The cases of MATH.md 2.6, whose variances are known by quadrature, then a grid over material, exponent and
/// angle.
[[nodiscard]] std::vector<Case> sampling_cases(bool quick);

/// Measures and writes sampling.csv to the folder as it goes; strategies take turns, so that they share what
/// else the machine does. Prints a summary. @throws UsageError, DeviceError, WriteError
void measure_sampling(const SamplingOptions& options);

} // namespace phlux::bench
