// Traversal on a device against Embree on the same rays, in one process, alternating.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/common/options.h"
#include "render/render.h"

namespace phlux::bench {

struct RaysOptions : CommonOptions {
  std::vector<std::uint64_t> triangles = {36, 20'000, 500'000};
  render::Traversal traversal = render::Traversal::automatic;
  int rounds = 7; ///< alternations; medians are quoted
};

/// Writes rays.csv (the columns of the contract, then the Embree call) to the folder and prints each line as
/// it comes, then charts and the report. Both sides use as many threads as the device has units. @throws
/// DeviceError, WriteError, also where charts cannot be drawn: the table is there then
void measure_rays(const RaysOptions& options);

} // namespace phlux::bench
