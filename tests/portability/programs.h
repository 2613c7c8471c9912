// The programs that are compiled for devices that are not here.
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

/// Parts that Parts::set() knows, and reflectance models that ship.
[[nodiscard]] std::vector<std::string> all_parts();

/// A program of a scene, whose parts are known by name.
struct SceneProgram {
  std::string name;
  render::Parts parts;
};

[[nodiscard]] const std::vector<SceneProgram>& scene_programs();
[[nodiscard]] Program program_of(const SceneProgram& scene, int width = 1);
/// All programs in all their widths: those of scenes, and those that know none.
[[nodiscard]] std::vector<Program> programs();

/// A program that has every part, or the same without one part and what cannot be without it.
struct Ablation {
  std::string base; ///< such as "path-exact": programs that differ in their parts alone
  std::string part; ///< the one that is left out; empty: none
  render::Parts parts;
};
/// Of all integrators, and of path tracing by a strategy that shares code with other reflectance models.
[[nodiscard]] std::vector<Ablation> ablations();

} // namespace phlux::test
