// Which kernels a test program tests.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace phlux::test {

/// The folder that the environment variable PHLUX_TEST_KERNELS names: to see that a test fails when they are
/// wrong. Empty: the embedded ones.
inline std::filesystem::path tested_kernels() {
  const char* folder = std::getenv("PHLUX_TEST_KERNELS");
  return folder == nullptr ? "" : folder;
}

} // namespace phlux::test
