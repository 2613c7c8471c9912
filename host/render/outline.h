// How a device would render a scene, without rendering it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "device/device.h"
#include "render/parts.h"

namespace phlux::render {

struct Outline {
  device::DeviceInfo device; ///< the first of the settings' devices
  Parts parts;
  std::uint64_t primitives = 0; ///< that rays are tested against
  std::size_t table_bytes = 0;  ///< of the scene's tables in the device's memory
};

/// @throws UsageError, SceneError and DeviceError as Renderer
[[nodiscard]] Outline outline(const scene::Scene& scene, const Settings& settings);

} // namespace phlux::render
