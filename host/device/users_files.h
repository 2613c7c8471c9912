// The kernel files of a program that its user wrote.
#pragma once

#include <string>

#include "device/program.h"

namespace phlux::device {

/// Whether `file` is one that the program's source contains, but for the generated list of its models: an
/// error in it is one of the input, not of the device.
[[nodiscard]] inline bool is_users_file(const ProgramSource& source, const std::string& file) {
  return file != "lobes/models.cl" && source.files.contains(file);
}

} // namespace phlux::device
