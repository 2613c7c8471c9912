// `phlux verify`: whether sampling, evaluating and integrating the reflectance model agree on a device, with
// one another and with float64 (CW 197, section 5, and what has come since).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/program.h"
#include "verify/report.h"

namespace phlux::verify {

struct Settings {
  int lanes = 0;                       ///< WIDTH
  bool quick = false;                  ///< fewer cases and samples
  std::size_t samples = 0;             ///< per case; 0: what suits `quick` and the device
  std::vector<std::string> strategies; ///< names; empty: all
  sources::KernelFiles kernels;
  std::function<void(const std::string&)> progress; ///< called with the name of what comes next
};

/// Samples of each case on a device.
[[nodiscard]] std::size_t samples_of(const device::Device& device, const Settings& settings);

/// Runs all checks of the Phong model on one device. @throws DeviceError
[[nodiscard]] Report run(const device::Device& device, const Settings& settings);

/// Writes the histograms of failed checks as CSV, and as PNG where they are grids, into the working
/// directory.
/// @throws WriteError
void write_failures(Report& report);

} // namespace phlux::verify
