// How many work-items a launch has, and how many of them are a group.
#pragma once

#include <cstddef>

namespace phlux::device {

/// A size is always given: left to the driver, PoCL would choose one for each launch and build the kernel
/// anew. 64 where a work-item carries one path, as lanes of a GPU do; else 1.
[[nodiscard]] inline std::size_t group_size(int lanes) {
  return lanes == 1 ? 64 : 1;
}

/// The least number of whole groups' work-items with a lane for each of `elements`.
[[nodiscard]] inline std::size_t items_for(std::size_t elements, int lanes) {
  const std::size_t per_group = group_size(lanes) * static_cast<std::size_t>(lanes);
  return (elements + per_group - 1) / per_group * group_size(lanes);
}

} // namespace phlux::device
