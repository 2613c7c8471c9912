// A hash of a scene.
#pragma once

#include <string>

#include "scene/scene.h"

namespace phlux::scene {

/// 32 hexadecimal digits (XXH3, 128 bits) of everything that the radiance depends on: all but the image's
/// size in pixels and RenderDefaults. Numbers are rounded to float32, so that machines whose sines differ in
/// their last digits agree.
[[nodiscard]] std::string digest(const Scene& scene);

} // namespace phlux::scene
