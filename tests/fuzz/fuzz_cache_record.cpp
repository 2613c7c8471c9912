// Records of the driver's cache: one that encodes to itself and names a folder of the driver, or nothing.
#include <cstdlib>

#include "device/driver_cache.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  const std::string text(reinterpret_cast<const char*>(bytes), count);
  if (const auto record = phlux::device::DriverRecord::decode(text)) {
    const auto again = phlux::device::DriverRecord::decode(record->encode());
    if (!again || again->digests != record->digests || record->folder.find("..") != std::string::npos)
      std::abort();
  }
  return 0;
}
