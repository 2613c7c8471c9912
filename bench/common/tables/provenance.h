// How a measurement was made, for the report: command, device, versions, seeds.
#pragma once

#include <filesystem>
#include <string>

#include "device/device.h"

namespace phlux::bench {

struct Provenance {
  std::string command; ///< that repeats it: "phlux bench sampling --quick --seed 1"
  device::DeviceInfo device;
  int lanes = 0;            ///< WIDTH
  std::string kernel_cache; ///< text: whether kernels were built in this run, and that timings exclude it
  std::string seeds;        ///< text: "1 to 10"
};

/// Writes `folder`/`name`.provenance.json; adds the versions of Phlux and the compiler, and the date.
/// @throws WriteError
void write_provenance(const std::filesystem::path& folder, const std::string& name,
                      const Provenance& provenance);

} // namespace phlux::bench
