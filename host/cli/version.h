// What `phlux --version` prints: all that a report of a fault should say of the program and the machine.
#pragma once

#include <string>

namespace phlux::cli {

/// Lines of a name and what it is: version, commit, compiler, libraries, OpenCL's loader and platforms, none
/// of which need be there. The first is "phlux VERSION".
[[nodiscard]] std::string version_report();

} // namespace phlux::cli
