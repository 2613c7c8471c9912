// Colours as in Mitsuba's RGB mode: linear, with Rec. 709 primaries.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// One number (grey), three numbers, or #rrggbb. As in Mitsuba 0.6, <rgb> is linear in all of these forms;
/// only <srgb> is decoded from sRGB (IEC 61966-2-1).
/// @throws SceneError
[[nodiscard]] scene::Rgb read_color(const Element& property);

/// The linear value of an sRGB-encoded one, both from 0 to 1 (IEC 61966-2-1).
[[nodiscard]] double decode_srgb(double encoded);

} // namespace phlux::scene_file
