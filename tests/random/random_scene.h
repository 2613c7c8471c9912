// Small valid scenes over all that a scene file may say (CONTRACT.md), each from two numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "scene/scene.h"

namespace phlux::test {

/// Scenes of one family are built of the same kinds of shapes, materials and lights, so that they share their
/// kernels, whose building would otherwise take most of the time. All else differs among its members.
struct SceneNumber {
  std::uint64_t family = 0, member = 0;
};

struct RandomScene {
  std::string xml;
  std::map<std::string, std::string> meshes; ///< bytes by file name
};

/// No exponent of a family's scenes is larger.
[[nodiscard]] double most_exponent(std::uint64_t family);

[[nodiscard]] std::string name_of(const SceneNumber& number);
[[nodiscard]] RandomScene random_scene(const SceneNumber& number);

/// Writes NAME.xml and its meshes; returns the scene's path.
std::filesystem::path write_scene(const RandomScene& scene, const std::filesystem::path& folder,
                                  const std::string& name);
/// As the scene's file is read.
[[nodiscard]] scene::Scene load_random_scene(const SceneNumber& number);

} // namespace phlux::test
