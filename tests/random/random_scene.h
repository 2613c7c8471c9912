// Small valid scenes over all that a scene file may say (CONTRACT.md), each from two numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace phlux::test {

/// Scenes of one family are built of the same kinds of shapes, materials and lights, so that they share their
/// kernels, whose building would otherwise take most of the time. All else differs among its members.
struct SceneNumber {
  std::uint64_t family = 0, member = 0;
};

/// How a twin of a scene differs from it, so that what is rare in the scene is frequent in the twin. Its
/// kernels are the same.
struct Twin {
  double most_exponent = 0; ///< of lobes
  double least_lamp = 0;    ///< half edge of a shape that emits; the room's is 1
  int places = 0;           ///< if not 0: which other places camera, point and spot lights are given
};

struct RandomScene {
  std::string xml;
  std::map<std::string, std::string> meshes; ///< bytes by file name
};

/// No exponent of a family's scenes is larger.
[[nodiscard]] double most_exponent(std::uint64_t family);

[[nodiscard]] std::string name_of(const SceneNumber& number);
[[nodiscard]] RandomScene random_scene(const SceneNumber& number, const std::optional<Twin>& twin = {});

/// Writes NAME.xml and its meshes; returns the scene's path.
std::filesystem::path write_scene(const RandomScene& scene, const std::filesystem::path& folder,
                                  const std::string& name);
/// As the scene's file is read.
[[nodiscard]] scene::Scene load_random_scene(const SceneNumber& number, const std::optional<Twin>& twin = {});

} // namespace phlux::test
