// The lights of a random scene: emitters without area, and how bright and how many its lamps are.
#pragma once

#include <string>

#include "random/scene_draft.h"

namespace phlux::test {

class RandomLights {
public:
  /// `draft` lies in the world by now.
  explicit RandomLights(SceneDraft& draft);
  /// Writes the emitters without area. Closed rooms are lit from inside; one scene in 30 has no light.
  void write();
  /// Shapes that are to emit.
  [[nodiscard]] int lamps() const { return lamps_; }
  /// Of a lamp of half edge 1; of what gives as much light to the room, for an emitter without area.
  scene::Rgb color();

private:
  void emitter(const std::string& type);
  void spot(const scene::Rgb& color);
  scene::Vec3 lamp_place();

  SceneDraft& draft_;
  double radiance_;
  int lamps_ = 0;
  bool sky_ = false;
};

} // namespace phlux::test
