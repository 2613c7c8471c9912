// The kernels under test.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace phlux::test {

/// The folder in the environment variable PHLUX_TEST_KERNELS, with which a test of wrong kernels can be
/// checked to fail. Empty: the embedded kernels.
inline std::filesystem::path tested_kernels() {
  const char* folder = std::getenv("PHLUX_TEST_KERNELS");
  return folder == nullptr ? "" : folder;
}

} // namespace phlux::test
