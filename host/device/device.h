// OpenCL devices: which there are, which one the user means, and what phlux would do with each.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "device/opencl.h"

namespace phlux::device {

struct DeviceInfo {
  int platform_index = 0, device_index = 0; ///< as in `--device P:D`
  std::string platform, name, type;         ///< type: cpu, gpu or accelerator
  std::string driver, opencl_c_version;
  std::uint32_t compute_units = 0;
  std::uint64_t global_memory = 0, largest_buffer = 0; ///< bytes
  std::uint32_t native_float_width = 1;
  bool doubles = false; ///< kernels may compute in double
  int lanes = 1;        ///< the WIDTH that phlux would use: 1, 4, 8 or 16
};

/// Every device of every platform, in the drivers' order. A platform without devices is skipped with a
/// warning.
/// @throws DeviceError when there is no platform or no device at all, saying what to install
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// One device, its context and an in-order queue with profiling. Copies share them; they live until the
/// process ends.
struct Device {
  DeviceInfo info;
  cl::Device handle;
  cl::Context context;
  cl::CommandQueue queue;
};

/// The devices that the user's `--device` specifications name, each once; the default when there are none is
/// the first CPU, else the first device; the environment variable PHLUX_DEVICE replaces that default. A
/// specification is "P:D", "cpu", "gpu", "all" or a part of a device's or platform's name (case-insensitive).
/// @throws DeviceError when a specification names nothing, listing what there is
[[nodiscard]] std::vector<Device> open_devices(const std::vector<std::string>& specifications);

} // namespace phlux::device
