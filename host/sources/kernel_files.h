// The texts of the kernel files.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace phlux::sources {

/// Where kernel sources come from: the ones embedded in this binary, or a folder while developing.
class KernelFiles {
public:
  KernelFiles() = default; ///< the embedded files
  explicit KernelFiles(std::filesystem::path folder);
  /// The text of one kernel file, by its path relative to kernels/. @throws DeviceError when there is none
  [[nodiscard]] std::string read(const std::string& name) const;

private:
  std::filesystem::path folder_; // empty: embedded
};

} // namespace phlux::sources
