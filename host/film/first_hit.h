// Properties of the first surface that camera rays hit, for denoisers and compositing.
#pragma once

#include <array>

namespace phlux::film {

struct FirstHitValues {
  std::array<float, 3> albedo{}; ///< the fraction of light from the camera's direction that is scattered
  std::array<float, 3> normal{}; ///< shading normal in world space, on the side that is seen
  float depth = 0.0F; ///< distance along the camera's axis; mean over the samples that hit anything
};

/// Means over the samples of a pixel, and the variances of these means; that of a depth which fewer than two
/// samples have is 0. Laid out as FeatureWords.
struct FirstHit {
  FirstHitValues mean, variance;
};

} // namespace phlux::film
