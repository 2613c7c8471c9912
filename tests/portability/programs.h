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

/// A program that has every part, and the same without one part and what cannot be without it.
struct Ablation {
  std::string part; ///< empty: the program that has every part
  render::Parts parts;
};
[[nodiscard]] std::vector<Ablation> ablations(render::Integrator integrator);

} // namespace phlux::test
