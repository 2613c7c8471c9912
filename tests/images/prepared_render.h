// Many renders of one scene by one method with kernels that are built once.
#pragma once

#include <cstdint>

#include "device/program.h"
#include "film/film.h"
#include "render/device_scene.h"
#include "render/launcher.h"

namespace phlux::test {

/// render::render() on one device, prepared once: for small images, PoCL's look-up of built kernels in its
/// cache takes longer than rendering.
class PreparedRender {
public:
  /// @throws as render::render()
  PreparedRender(const scene::Scene& scene, const render::Settings& settings);

  struct Image {
    film::Film film;
    std::uint64_t nonfinite = 0;
  };
  [[nodiscard]] Image image(std::uint64_t seed, int samples_per_pixel) const;

private:
  const scene::Scene& scene_;
  render::Settings settings_;
  device::Device device_;
  int lanes_;
  render::HostScene host_;
  render::Parts parts_;
  device::BuiltProgram program_;
};

} // namespace phlux::test
