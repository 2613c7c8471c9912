// The device on which a test program runs its kernels, and the kernels that it tests.
#pragma once

#include <cstddef>

#include "device/device.h"
#include "sources/kernel_files.h"
#include "tested_kernels.h"

namespace phlux::test {

/// PHLUX_DEVICE, else the first CPU. Never released, as drivers may be gone when static objects are
/// destroyed.
inline const device::Device& test_device() {
  static const auto& device = *new device::Device(device::open_devices({}).front());
  return device;
}

/// Interpreters of kernels are some thousand times slower: sweeps are thinned out there.
inline std::size_t thinned(std::size_t count, std::size_t factor = 64) {
  return test_device().info.platform == "Oclgrind" ? count / factor + 1 : count;
}

inline sources::KernelFiles kernel_files() {
  const std::filesystem::path folder = tested_kernels();
  return folder.empty() ? sources::KernelFiles() : sources::KernelFiles(folder);
}

} // namespace phlux::test
