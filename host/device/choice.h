// Selects devices by the user's specifications.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "device/device.h"

namespace phlux::device {

struct Choice {
  std::vector<std::size_t> devices; ///< distinct indices into the devices, in the order of specifications
  std::vector<std::string> notes;   ///< a line for each that was left out or shares its cores with another
};

/// The devices that match `specifications`; without any, the first CPU, else the first device.
///
/// A specification is "P:D", "cpu", "gpu", "all", or a part of a name, case-insensitive. It is compared with
/// platforms' names first, and with devices' names only if no platform matches, as a device's name may
/// contain its vendor. The CPUs of two platforms are the same cores with two drivers: "cpu" and a part of a
/// name choose those of the first platform; "all" and several specifications choose all. Both add a note.
/// @throws DeviceError when a specification matches nothing, with a list of all devices
[[nodiscard]] Choice choose(const std::vector<std::string>& specifications,
                            const std::vector<DeviceInfo>& devices);

} // namespace phlux::device
