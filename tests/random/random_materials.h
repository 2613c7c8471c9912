// The materials of a random scene.
#pragma once

#include <string>
#include <vector>

#include "random/scene_draft.h"

namespace phlux::test {

class RandomMaterials {
public:
  RandomMaterials(SceneDraft& draft, double most_exponent);
  /// Writes all materials into the file.
  void write();
  /// Gives one of them to the open shape; a lamp is not masked.
  void refer_to_one(bool lamp = false);

private:
  void write_one(int index);
  void color(const char* name, const scene::Rgb& value);
  void texture(const char* name, const scene::Rgb& largest);
  void opacity();
  void lobes(const std::string& type, const std::string& id);
  void fresnel(const std::string& type, const std::string& id);
  double exponent();

  SceneDraft& draft_;
  double most_exponent_;
  int count_ = 0, images_ = 0;
  std::vector<bool> masked_;
};

} // namespace phlux::test
