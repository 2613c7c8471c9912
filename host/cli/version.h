// The text of `phlux --version`: commit, compiler, libraries and OpenCL platforms.
#pragma once

#include <string>

namespace phlux::cli {

/// "phlux VERSION", then a line each for commit, compiler, libraries, the OpenCL loader and every platform.
[[nodiscard]] std::string version_report();

} // namespace phlux::cli
