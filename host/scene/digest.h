// What tells scenes apart.
#pragma once

#include <string>

#include "scene/scene.h"

namespace phlux::scene {

/// 32 hexadecimal digits (XXH3, 128 bits) of all that a scene's radiance depends on: everything but the
/// image's size in pixels and RenderDefaults. Numbers count as float32, so that machines whose sines differ
/// in their last digits agree.
[[nodiscard]] std::string digest(const Scene& scene);

} // namespace phlux::scene
