// The text of kernel files.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace phlux::sources {

/// A source of kernel files: those embedded in this program, or a folder, for development.
class KernelFiles {
public:
  KernelFiles() = default;                            ///< the embedded files
  explicit KernelFiles(std::filesystem::path folder); ///< empty: the embedded files
  /// The text of one kernel file, by its path relative to kernels/. @throws DeviceError when there is none
  [[nodiscard]] std::string read(const std::string& name) const;

private:
  std::filesystem::path folder_; // empty: embedded
};

} // namespace phlux::sources
