// The lights of a random scene: emitters without area, and the number and brightness of its lamps.
#pragma once

#include <string>

#include "random/scene_draft.h"

namespace phlux::test {

class RandomLights {
public:
  /// `draft` must already be placed in the world.
  explicit RandomLights(SceneDraft& draft);
  /// Writes the emitters without area. Closed rooms are lit from inside; one scene in 30 has no light.
  void write();
  /// Number of emitting shapes.
  [[nodiscard]] int lamps() const { return lamps_; }
  /// Radiance of a lamp of half edge 1; for an emitter without area, that which gives the room as much light.
  scene::Rgb color();

private:
  void emitter(const std::string& type);
  void spot(const scene::Rgb& color);
  void environment_map(const scene::Rgb& color);
  scene::Vec3 lamp_place();

  SceneDraft& draft_;
  double radiance_;
  int lamps_ = 0;
  bool sky_ = false;
  bool maps_; ///< the sky is an environment map, not constant
};

} // namespace phlux::test
