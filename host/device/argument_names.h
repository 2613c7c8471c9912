// What the arguments of a program's kernels are called in its source.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "device/opencl.h"

namespace phlux::device {

/// The names of each kernel's arguments, in their order.
using ArgumentNames = std::map<std::string, std::vector<std::string>>;

/// As the driver says, which need not know them of a program that was loaded from a binary; without the
/// kernels whose arguments it does not name.
[[nodiscard]] ArgumentNames argument_names(cl::Program program);

/// A program's binary with the names of its kernels' arguments before it, to be kept, and back.
struct NamedBinary {
  ArgumentNames arguments;
  std::vector<unsigned char> binary;
};
[[nodiscard]] std::vector<unsigned char> encode(const NamedBinary& named);
[[nodiscard]] NamedBinary decode(const std::vector<unsigned char>& bytes);

} // namespace phlux::device
