// Many renders of one scene by one method, whose kernels are built once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/program.h"
#include "film/film.h"
#include "render/device_scene.h"
#include "render/launcher.h"

namespace phlux::test {

/// Means of independent renders, quantity by quantity: each channel of the whole image and of its tiles.
struct RepeatedMeans {
  std::vector<std::string> names;
  std::vector<double> mean, variance; ///< of one render
  int renders = 0;
  std::string defect; ///< what no image may have: values that are not numbers, or negative
};

class RepeatedRender {
public:
  /// @throws what render::render() throws
  RepeatedRender(const scene::Scene& scene, const render::Settings& method);
  /// Renders with the seeds from `seed` on.
  [[nodiscard]] RepeatedMeans means(std::uint64_t seed, int renders, int samples_per_pixel) const;

private:
  [[nodiscard]] film::Film image(std::uint64_t seed, int samples_per_pixel, std::uint64_t& nonfinite) const;

  const scene::Scene& scene_;
  render::Settings method_;
  device::Device device_;
  render::HostScene host_;
  render::Parts parts_;
  cl::Program program_;
};

} // namespace phlux::test
