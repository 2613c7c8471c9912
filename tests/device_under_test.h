// The device under test and the kernels under test.
#pragma once

#include <cstddef>

#include "device/device.h"
#include "sources/kernel_files.h"
#include "tested_kernels.h"

namespace phlux::test {

/// PHLUX_DEVICE, else the first CPU. Never released, because drivers may be unloaded before static objects
/// are destroyed.
inline const device::Device& test_device() {
  static const auto& device = *new device::Device(device::open_devices({}).front());
  return device;
}

/// Whether the device interprets kernels, a thousand times slower: tests then use fewer cases.
inline std::size_t thinned(std::size_t count, std::size_t factor = 64) {
  return test_device().info.platform == "Oclgrind" ? count / factor + 1 : count;
}

inline sources::KernelFiles kernel_files() {
  return sources::KernelFiles(tested_kernels());
}

} // namespace phlux::test
