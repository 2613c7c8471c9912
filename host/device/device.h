// Lists and opens OpenCL devices.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
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
  int lanes = 1;        ///< default WIDTH: 1, 4, 8 or 16
};

struct PlatformInfo {
  int index = 0; ///< the P of a specification P:D
  std::string name, version;
  int devices = 0; ///< their number; 0 for a driver without its hardware
};

/// All platforms, possibly none, in the drivers' order.
[[nodiscard]] std::vector<PlatformInfo> list_platforms();

/// Name and version of the library that loads the drivers, such as "OpenCL ICD Loader 2.3.1".
[[nodiscard]] std::string icd_loader();

/// All devices of all platforms, in the drivers' order.
/// @throws DeviceError when there is none, saying what to install
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// A device, its context and an in-order queue with profiling. Copies share these; they are never released.
struct Device {
  DeviceInfo info;
  cl::Device handle;
  cl::Context context;
  cl::CommandQueue queue;
};

/// An in-order queue with profiling. @throws cl::Error
[[nodiscard]] cl::CommandQueue make_queue(const cl::Context& context, const cl::Device& handle);

/// Opens the devices that choose() selects; without specifications, by the environment variable PHLUX_DEVICE
/// if set. Each note of the choice is logged once, as a warning. With `threads`, each is a CPU of which only
/// so many compute units are used, as a sub-device.
/// @throws DeviceError as choose(), and when a device cannot be opened or divided
[[nodiscard]] std::vector<Device> open_devices(const std::vector<std::string>& specifications,
                                               std::optional<int> threads = {});

/// Those that open_devices() opens. @throws DeviceError as choose()
[[nodiscard]] std::vector<DeviceInfo> chosen_devices(const std::vector<std::string>& specifications);

/// Forgets the open devices: open_devices() makes new contexts and queues, as a driver does not recover those
/// of a device that has failed.
void reopen_devices();

} // namespace phlux::device
