// What a measurement was made with, for the report.
#pragma once

#include <filesystem>
#include <string>

#include "device/device.h"

namespace phlux::bench {

struct Provenance {
  std::string command; ///< repeats it: "phlux bench sampling --quick --seed 1"
  device::DeviceInfo device;
  int lanes = 0;            ///< WIDTH
  std::string kernel_cache; ///< in words: whether kernels were built in this run, and that timings exclude it
  std::string seeds;        ///< in words: "1 to 10"
};

/// Writes `folder`/`name`.provenance.json, with the version of phlux and the date. @throws WriteError
void write_provenance(const std::filesystem::path& folder, const std::string& name,
                      const Provenance& provenance);

} // namespace phlux::bench
