// Colours as in Mitsuba's RGB mode: linear, with Rec. 709 primaries.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// A linear channel of an encoded one (IEC 61966-2-1).
[[nodiscard]] double decode_srgb(double encoded);

/// <rgb>, <srgb>, <xyz>, <spectrum>, <blackbody> or <float>. As in Mitsuba 0.6, <rgb> is linear in all of its
/// forms; only <srgb> is decoded from sRGB (IEC 61966-2-1). Spectra (wavelength:value pairs, .spd files, the
/// plugins of Mitsuba 2 and 3) become colours as in Mitsuba's RGB modes: of a reflectance as seen in D65, or
/// in 0.x in equal energy; of `emission` as they are. Negative channels become 0, reflectances at most 1.
/// @throws SceneError
[[nodiscard]] scene::Rgb read_color(const Element& property, const Document& document, bool emission);

/// The linear value of an sRGB-encoded one, both from 0 to 1 (IEC 61966-2-1).
[[nodiscard]] double decode_srgb(double encoded);

} // namespace phlux::scene_file
