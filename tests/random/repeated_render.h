// Means of many renders of one scene by one method.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "images/prepared_render.h"

namespace phlux::test {

/// Means of independent renders, quantity by quantity: each channel of the whole image and of its tiles.
struct RepeatedMeans {
  std::vector<std::string> names;
  std::vector<double> mean, variance; ///< of one render
  std::vector<double> pixels;         ///< that a quantity is the mean of
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
  PreparedRender prepared_;
  int width_, height_;
};

} // namespace phlux::test
