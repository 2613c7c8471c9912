// A scene with every kind of shape, material and light, in which any of the lights can be on. All variants
// have the same kernels.
#pragma once

#include <string>
#include <vector>

#include "images/scenes.h"

namespace phlux::test {

/// Names of the emitters, for room().
[[nodiscard]] const std::vector<std::string>& emitter_kinds();

/// The room with these emitters on and the others without power. No two of its surfaces are close to each
/// other, so that 1 / distance^2 of a connection is bounded.
[[nodiscard]] scene::Scene room(const std::vector<std::string>& shining);

} // namespace phlux::test
