// From linear radiance to what a screen shows.
#pragma once

#include <array>
#include <cstdint>

#include "files/image.h"

namespace phlux::files {

/// The factor that brings the image's log-average luminance to middle grey, 0.18 (Reinhard and others 2002,
/// "Photographic tone reproduction for digital images", equations 1 and 2), or less where the bright parts of
/// a picture of high contrast would burn out: the 95th percentile is exposed to 1 at most. Black pixels do
/// not count, and the darkest and brightest 5% of the others not in the average, so that neither a light in
/// view nor a dark background decides; 1 for a black image. `image` has channels R, G, B.
[[nodiscard]] float exposure(const Image& image);

/// One exposed linear value >= 0 to [0, 1): itself up to 0.6, above that a shoulder that nears 1 with a
/// continuous slope, so that middle tones keep their colours and highlights fade into white. NaN and negative
/// values become 0.
[[nodiscard]] float compress_highlights(float value);

/// The sRGB code of a linear value, IEC 61966-2-1; clamped to [0, 255].
[[nodiscard]] std::uint8_t srgb_code(float linear);

} // namespace phlux::files
