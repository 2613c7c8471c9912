// Methods that are known to be biased in a scene.
#pragma once

#include <string>

#include "bench/common/methods/method.h"

namespace phlux::bench {

/// Whether the camera sees a mirror or smooth glass, directly or through masks. Light tracing shows these
/// black, because a delta distribution cannot be connected to the camera. Determined on the device of the
/// settings from a few camera rays per pixel. @throws as render::first_hits()
[[nodiscard]] bool shows_delta(scene::Scene scene, const render::Settings& settings);

class KnownBias {
public:
  /// `settings` name the device. @throws as shows_delta()
  KnownBias(const scene::Scene& scene, const render::Settings& settings);
  /// Why the method is biased, as text; empty if it is not known to be.
  [[nodiscard]] std::string of(const Method& method) const;

private:
  bool has_unhittable_lights_, eye_paths_miss_light_, shows_delta_;
};

} // namespace phlux::bench
