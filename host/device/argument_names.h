// The names of kernels' arguments.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "device/opencl.h"

namespace phlux::device {

/// The names of each kernel's arguments, in their order.
using ArgumentNames = std::map<std::string, std::vector<std::string>>;

/// From the driver, without the kernels whose names it does not know, such as those of a program from a
/// binary.
[[nodiscard]] ArgumentNames argument_names(cl::Program program);

/// A program's binary with the names of its kernels' arguments, as the binary cache stores it.
struct NamedBinary {
  ArgumentNames arguments;
  std::vector<unsigned char> binary;
};
[[nodiscard]] std::vector<unsigned char> encode(const NamedBinary& named);
[[nodiscard]] NamedBinary decode(const std::vector<unsigned char>& bytes);

} // namespace phlux::device
