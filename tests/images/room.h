// A scene that holds every kind of shape, material and light, in which any of the lights can be on. The
// kernels of all its variants are the same.
#pragma once

#include <string>
#include <vector>

#include "images/scenes.h"

namespace phlux::test {

/// Names that room() takes: what can shine.
[[nodiscard]] const std::vector<std::string>& emitter_kinds();

/// The room with these emitters on and the others without power. No two of its surfaces come close, so that a
/// connection's 1 / distance^2 is bounded.
[[nodiscard]] scene::Scene room(const std::vector<std::string>& shining);

} // namespace phlux::test
