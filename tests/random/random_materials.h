// The materials of a random scene.
#pragma once

#include <string>

#include "random/scene_draft.h"

namespace phlux::test {

class RandomMaterials {
public:
  RandomMaterials(SceneDraft& draft, double most_exponent);
  /// Writes all materials into the file.
  void write();
  /// Gives one of them to the open shape.
  void refer_to_one();

private:
  void lobes(const std::string& type, const std::string& id);
  void fresnel(const std::string& type, const std::string& id);
  double exponent();

  SceneDraft& draft_;
  double most_exponent_;
  int count_ = 0;
};

} // namespace phlux::test
