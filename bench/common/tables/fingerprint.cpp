#include "bench/common/tables/fingerprint.h"

#include <fmt/format.h>

namespace phlux::bench {

void Fingerprint::add(const void* bytes, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    hash_ = (hash_ ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3ull;
}

std::string Fingerprint::text() const {
  return fmt::format("{:016x}", hash_);
}

} // namespace phlux::bench
