// Buffers of a device.
#pragma once

#include <cstddef>

#include "device/device.h"

namespace phlux::device {

/// A buffer of `bytes` bytes, a copy of those at `data` unless that is null. A CPU's buffer is the host's
/// memory, in large pages (large_pages.h), since kernels read nodes, triangles and textures at random.
/// @throws cl::Error
[[nodiscard]] cl::Buffer make_buffer(const Device& device, cl_mem_flags flags, std::size_t bytes,
                                     const void* data = nullptr);

} // namespace phlux::device
