// Colours as in Mitsuba's RGB mode: linear, with Rec. 709 primaries.
#pragma once

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

/// A linear channel of an encoded one (IEC 61966-2-1).
[[nodiscard]] double decode_srgb(double encoded);

/// <rgb>, <srgb>, <xyz>, <spectrum>, <blackbody> or <float>. As in Mitsuba 0.6, <rgb> is linear in all of its
/// forms; only <srgb> is decoded from sRGB (IEC 61966-2-1). Spectra (wavelength:value pairs, .spd files, the
/// plugins of Mitsuba 2 and 3) become colours as in Mitsuba's RGB modes: of a material as seen in D65, or in
/// 0.x in equal energy; of `emission` as they are. Their negative channels become 0, and those above `most`
/// (1 for a reflectance) `most`. From version 2 on, <spectrum> with a single number is a constant spectrum.
/// @throws SceneError
[[nodiscard]] scene::Rgb read_color(const Element& property, const Document& document, bool emission,
                                    double most);

} // namespace phlux::scene_file
