// Twins of scenes with doubts: scenes with the same kernels in which no method depends on rare samples.
#pragma once

#include <optional>
#include <vector>

#include "random/random_scene.h"
#include "render/render.h"

namespace phlux::test {

/// For a scene in which some methods have heavy tails, the twin that differs least from it and in which none
/// has: exponents are limited, lamps have a least size, and only if that is not enough, camera, point and
/// spot lights are moved. Nothing if no method has doubts.
/// @throws std::runtime_error if there is no such twin
[[nodiscard]] std::optional<Twin> twin_of(const SceneNumber& number,
                                          const std::vector<render::Settings>& methods);

} // namespace phlux::test
