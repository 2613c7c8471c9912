// A copy of kernels/ with one mistake in it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "temporary_folder.h"

class KernelCopy {
public:
  /// Replaces the only occurrence of `from` in `file`.
  KernelCopy(const std::string& file, const std::string& from, const std::string& to) {
    std::filesystem::copy(PHLUX_SOURCE_DIR "/kernels", folder_.path(),
                          std::filesystem::copy_options::recursive);
    std::string text = TemporaryFolder::read(folder_ / file);
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(file + " does not hold: " + from);
    folder_.write(file, text.replace(at, from.size(), to));
  }

  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

private:
  TemporaryFolder folder_;
};
