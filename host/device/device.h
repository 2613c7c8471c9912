// OpenCL devices: which there are, which one the user means, and what phlux would do with each.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "device/opencl.h"

namespace phlux::device {

struct DeviceInfo {
  int platform_index = 0, device_index = 0; ///< the P and D of a specification P:D
  std::string platform, name, type;         ///< type: cpu, gpu or accelerator
  std::string driver, opencl_c_version;
  std::uint32_t compute_units = 0;
  std::uint64_t global_memory = 0, largest_buffer = 0; ///< bytes
  std::uint32_t native_float_width = 1;
  bool doubles = false; ///< kernels may compute in double
  int lanes = 1;        ///< the WIDTH that phlux would use: 1, 4, 8 or 16
};

struct PlatformInfo {
  int index = 0; ///< the P of a specification P:D
  std::string name, version;
  int devices = 0; ///< how many it has; a driver without its hardware has none
};

/// Every platform, in the order of the drivers; none is no error.
[[nodiscard]] std::vector<PlatformInfo> list_platforms();

/// Name and version of the library that finds the drivers, such as "OpenCL ICD Loader 2.3.1".
[[nodiscard]] std::string icd_loader();

/// Every device of every platform, in the drivers' order.
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

/// The devices that the specifications name, as choice.h says; without any, that of the
/// environment variable PHLUX_DEVICE, and without that the default. A note of the choice is a warning, once.
/// @throws DeviceError when a specification names nothing, listing what there is
[[nodiscard]] std::vector<Device> open_devices(const std::vector<std::string>& specifications);

} // namespace phlux::device
