// Many renders of one scene by one method, with kernels that are built once.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "device/program.h"
#include "film/film.h"
#include "render/device_scene.h"
#include "render/launcher.h"

namespace phlux::render {

/// The programs of one device that are in use. Scenes with the same parts share a program.
class Programs {
public:
  Programs(device::Device device, sources::KernelFiles files)
      : device_(std::move(device)), files_(std::move(files)) {}

  [[nodiscard]] const device::Device& device() const { return device_; }
  /// Builds the program, unless it was asked for before. @throws DeviceError
  [[nodiscard]] device::BuiltProgram program(const Parts& parts);

private:
  device::Device device_;
  sources::KernelFiles files_;
  std::map<std::map<std::string, std::string>, device::BuiltProgram> kept_; // by macros and file
};

/// render() on one device, prepared once: for small images, PoCL's look-up of built kernels in its cache
/// takes longer than rendering.
class PreparedRender {
public:
  /// The devices and the kernel folder of `settings` are ignored: they are those of `programs`.
  /// @throws as render()
  PreparedRender(Programs& programs, const scene::Scene& scene, const Settings& settings);

  struct Image {
    film::Film film;
    std::uint64_t nonfinite = 0;
  };
  /// The image that render() makes with this seed and number of samples, bit for bit. @throws DeviceError
  [[nodiscard]] Image image(std::uint64_t seed, int samples_per_pixel) const;

private:
  Settings settings_;
  device::Device device_;
  int width_, height_;
  HostScene host_;
  Parts parts_;
  device::BuiltProgram program_;
};

} // namespace phlux::render
