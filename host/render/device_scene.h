// A scene's tables in a device's memory, as arguments of a kernel.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "device/kernel.h"
#include "render/parts.h"
#include "tables/host_scene.h"

namespace phlux::render {

using tables::HostScene;
using tables::prepare;

class DeviceScene {
public:
  /// Copies the tables. @throws DeviceError when they do not fit, with their size
  DeviceScene(const device::Device& device, const HostScene& scene, const Parts& parts);

  /// Sets the arguments that SCENE_PARAMETERS (kernels/scene/scene.cl) declares.
  void bind(device::Kernel& kernel) const;

  [[nodiscard]] std::size_t bytes() const; ///< of the tables

private:
  std::vector<std::pair<const char*, std::variant<cl::Buffer, cl_int, cl_float>>>
      arguments_; // by their names
};

} // namespace phlux::render
