// Numbers of work-items of a launch and of a work-group.
#pragma once

#include <cstddef>

namespace phlux::device {

/// 64 for one lane per work-item, as on GPUs; else 1. Always passed to the driver: PoCL would otherwise
/// choose a size for each launch and build the kernel again.
[[nodiscard]] inline std::size_t group_size(int lanes) {
  return lanes == 1 ? 64 : 1;
}

/// The smallest number of work-items, in whole groups, that has a lane for each of `elements`.
[[nodiscard]] inline std::size_t items_for(std::size_t elements, int lanes) {
  const std::size_t per_group = group_size(lanes) * static_cast<std::size_t>(lanes);
  return (elements + per_group - 1) / per_group * group_size(lanes);
}

} // namespace phlux::device
