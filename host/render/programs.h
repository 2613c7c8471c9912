// The programs of one device that are in use.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "device/program.h"
#include "render/parts.h"

namespace phlux::render {

/// Scenes and settings with the same parts share a program: PoCL's look-up of a built program takes longer
/// than the render of a small image.
class Programs {
public:
  Programs(device::Device device, sources::KernelFiles files)
      : device_(std::move(device)), files_(std::move(files)) {}

  [[nodiscard]] const device::Device& device() const { return device_; }
  /// Builds the program, unless it was asked for before. `slow` as in device::build(). @throws DeviceError
  [[nodiscard]] device::BuiltProgram program(const Parts& parts, const std::function<void()>& slow = {});

private:
  device::Device device_;
  sources::KernelFiles files_;
  std::map<std::map<std::string, std::string>, device::BuiltProgram> kept_; // by macros and file
};

} // namespace phlux::render
