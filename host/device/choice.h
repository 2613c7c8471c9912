// Which of the devices that there are the user means.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "device/device.h"

namespace phlux::device {

struct Choice {
  std::vector<std::size_t> devices; ///< indices into those that there are, each once, in the order named
  std::vector<std::string> notes;   ///< one line for each that was left out, or shares its cores with another
};

/// The devices that `specifications` name; the first CPU, else the first device, where there are none.
///
/// A specification is "P:D", "cpu", "gpu", "all", or a part of a name in any case: of platforms' names, and
/// of devices' names where no platform's has it, for a device's name can hold its processor's maker. CPUs of
/// two platforms are the same cores under two drivers: "cpu" and a part of a name take those of the first
/// platform alone; "all" and several specifications take them all. Either gives a note.
/// @throws DeviceError when a specification names nothing, listing what there is
[[nodiscard]] Choice choose(const std::vector<std::string>& specifications,
                            const std::vector<DeviceInfo>& devices);

} // namespace phlux::device
