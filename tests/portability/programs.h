// The programs that are compiled for other devices.
#pragma once

#include <string>
#include <vector>

#include "device/program.h"
#include "render/parts.h"

namespace phlux::test {

struct Program {
  std::string name; ///< with its width, such as "mesh.8"
  device::ProgramSource source;
};

/// Names of parts for Parts::set(), and shipped reflectance models.
[[nodiscard]] std::vector<std::string> all_parts();

/// A program of a scene, and the names of its parts.
struct SceneProgram {
  std::string name;
  render::Parts parts;
};

[[nodiscard]] const std::vector<SceneProgram>& scene_programs();
[[nodiscard]] Program program_of(const SceneProgram& scene, int width = 1);
/// All programs at every WIDTH: those of scenes, and those without a scene.
[[nodiscard]] std::vector<Program> programs();

/// A program with every part, or without one part and those that require it.
struct Ablation {
  std::string base; ///< such as "path-exact": programs that differ in their parts alone
  std::string part; ///< the one that is left out; empty: none
  render::Parts parts;
};
/// For all integrators, and for path tracing with a strategy that shares code with other reflectance models.
[[nodiscard]] std::vector<Ablation> ablations();

} // namespace phlux::test
