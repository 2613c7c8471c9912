// Traversal on a device against Embree on the same rays, in one process, alternating.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/render.h"

namespace phlux::bench {

struct RaysOptions {
  std::filesystem::path folder; ///< of rays.csv
  std::vector<std::uint64_t> triangles = {36, 20'000, 500'000};
  std::vector<std::string> devices; ///< --device specifications; the first one is measured
  int lanes = 0;                    ///< WIDTH; 0: what suits the device
  render::Traversal traversal = render::Traversal::automatic;
  std::filesystem::path kernel_dir; ///< empty: the embedded kernels
  int rounds = 7;                   ///< alternations; medians are quoted
};

/// Writes rays.csv (the columns of the contract, then the Embree call) to the folder and prints each line as
/// it comes, then charts and the report. Both sides use as many threads as the device has units. @throws
/// DeviceError, WriteError, also where charts cannot be drawn: the table is there then
void measure_rays(const RaysOptions& options);

} // namespace phlux::bench
