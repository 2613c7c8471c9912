// Properties of the first surface that camera rays hit, for denoisers and compositing.
#pragma once

#include <array>

namespace phlux::film {

/// Means over the samples of a pixel. Laid out as FeatureWords.
struct FirstHit {
  std::array<float, 3> albedo{}; ///< the fraction of light from the camera's direction that is scattered
  std::array<float, 3> normal{}; ///< shading normal in world space, on the side that is seen
  float depth = 0.0F; ///< distance along the camera's axis; mean over the samples that hit anything
};

} // namespace phlux::film
