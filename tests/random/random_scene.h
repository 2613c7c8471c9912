// Small valid scenes with everything that a scene file may contain, each from two numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace phlux::test {

/// Scenes of one family have the same kinds of shapes, materials and lights, so that they share their
/// kernels, which would otherwise take most of the time to build. Everything else differs.
struct SceneNumber {
  std::uint64_t family = 0, member = 0;
};

/// Changes to a scene that make a twin of it, in which rare paths are frequent. The twin has the same
/// kernels.
struct Twin {
  double most_exponent = 0; ///< of lobes
  double least_lamp = 0;    ///< half edge of a shape that emits; the room's is 1
  int places = 0;           ///< if not 0: which other places camera, point and spot lights are given
};

struct RandomScene {
  std::string xml;
  std::map<std::string, std::string> files; ///< bytes of meshes and images by file name
};

/// Upper bound of the exponents of a family.
[[nodiscard]] double most_exponent(std::uint64_t family);

[[nodiscard]] std::string name_of(const SceneNumber& number);
[[nodiscard]] RandomScene random_scene(const SceneNumber& number, const std::optional<Twin>& twin = {});

/// Writes NAME.xml and its other files; returns the scene's path.
std::filesystem::path write_scene(const RandomScene& scene, const std::filesystem::path& folder,
                                  const std::string& name);
/// Definitions for reading the file of the scene.
[[nodiscard]] scene::Scene load_random_scene(const SceneNumber& number, const std::optional<Twin>& twin = {});

} // namespace phlux::test
