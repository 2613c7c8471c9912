// Twins of scenes in doubt: scenes of the same kernels in which every method finds soon what there is to
// find.
#pragma once

#include <optional>
#include <vector>

#include "random/random_scene.h"
#include "render/render.h"

namespace phlux::test {

/// Of a scene in which tails of some of the methods are heavy, the twin that differs least from it and in
/// which no method's are: exponents are capped, lamps are no smaller than some size, and only where that does
/// not do, camera, point and spot lights stand elsewhere. Nothing where no method is in doubt.
/// @throws std::runtime_error where there is no such twin
[[nodiscard]] std::optional<Twin> twin_of(const SceneNumber& number,
                                          const std::vector<render::Settings>& methods);

} // namespace phlux::test
