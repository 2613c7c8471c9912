// Options that all measurements share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "device/device.h"

namespace phlux::bench {

struct CommonOptions {
  std::filesystem::path folder;     ///< for tables, charts and the report
  std::vector<std::string> devices; ///< device specifications; the first one is measured
  int lanes = 0;                    ///< WIDTH; 0: the default of the device
  std::filesystem::path kernel_dir; ///< empty: the embedded kernels

  /// Sets devices, WIDTH and kernels of settings, those of render() or of SceneBench.
  template<class Settings>
  void apply_to(Settings& settings) const {
    settings.devices = devices;
    settings.lanes = lanes;
    settings.kernel_dir = kernel_dir;
  }
  [[nodiscard]] int lanes_on(const device::DeviceInfo& device) const {
    return lanes != 0 ? lanes : device.lanes;
  }
};

} // namespace phlux::bench
