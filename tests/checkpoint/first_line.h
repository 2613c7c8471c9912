// Checkpoints as phlux has not written them, for tests and the fuzzer.
#pragma once

#include <string>

#include <fmt/format.h>
#include <xxhash.h>

namespace phlux::test {

/// A checkpoint of these bytes after its first line, which has their digest and length.
inline std::string with_first_line(const std::string& bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("phlux checkpoint 5 {:016x}{:016x} {:020}\n", hash.high64, hash.low64, bytes.size()) +
         bytes;
}

} // namespace phlux::test
