// `phlux verify`: checks that sampling, evaluation and reflectivity of the reflectance model agree on a
// device, with one another and with float64 (CW 197, section 5, and further checks), and that the integrators
// render a known radiance.
#pragma once

#include <string>
#include <vector>

#include "device/program.h"
#include "verify/report.h"

namespace phlux::verify {

struct Settings {
  int lanes = 0;           ///< WIDTH
  bool quick = false;      ///< fewer cases and samples
  std::size_t samples = 0; ///< per case; 0: by `quick` and the device
  /// Names of what is verified. If both are empty: all strategies, the model and all integrators. The model
  /// is verified with the first strategy.
  std::vector<std::string> strategies, integrators;
  sources::KernelFiles kernels;
};

/// Number of samples per case on a device.
[[nodiscard]] std::size_t samples_of(const device::Device& device, const Settings& settings);

/// Runs the checks of the Phong model and of the integrators on one device. @throws DeviceError
[[nodiscard]] Report run(const device::Device& device, const Settings& settings);

/// Writes the histograms of failed checks as CSV, and those on square grids as PNG, to the working directory.
/// @throws WriteError
void write_failures(Report& report);

} // namespace phlux::verify
