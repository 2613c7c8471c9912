// Compares ray traversal on a device with Embree: the same rays in one process, alternating.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/common/options.h"
#include "render/render.h"

namespace phlux::bench {

struct RaysOptions : CommonOptions {
  std::vector<std::uint64_t> triangles = {36, 20'000, 500'000};
  render::Traversal traversal = render::Traversal::automatic;
  int rounds = 7; ///< of which the medians are reported
};

/// Writes rays.csv (the fixed columns, then the Embree call) and prints its rows, then writes
/// charts and the report. Embree uses as many threads as the device has compute units. @throws DeviceError;
/// WriteError, also if the charts cannot be drawn, when the table is complete
void measure_rays(const RaysOptions& options);

} // namespace phlux::bench
