// Tone mapping: from linear radiance to sRGB.
#pragma once

#include <array>
#include <cstdint>

#include "files/image.h"

namespace phlux::files {

/// The factor that maps the image's log-average luminance to middle grey, 0.18 (Reinhard and others 2002,
/// "Photographic tone reproduction for digital images", equations 1 and 2), reduced so that the 95th
/// percentile is at most 1. Black pixels are ignored, and the darkest and brightest 5% of the others are not
/// averaged, so that neither a visible light nor a dark background determines the exposure. 1 for a black
/// image. `rows` needs channels R, G, B. Of images above 4 million pixels it takes a part of the pixels.
[[nodiscard]] float exposure(const Rows& rows);
[[nodiscard]] inline float exposure(const Image& image) {
  return exposure(rows_of(image));
}

/// Maps an exposed linear value to [0, 1): the identity up to 0.6, above it an exponential shoulder towards 1
/// with a continuous slope, so that middle tones keep their colours and highlights fade to white. NaN and
/// negative values become 0.
[[nodiscard]] float compress_highlights(float value);

/// A linear value clamped to [0, 1] and encoded as sRGB, IEC 61966-2-1.
[[nodiscard]] float srgb(float linear);
/// The same as an 8-bit code, in [0, 255].
[[nodiscard]] std::uint8_t srgb_code(float linear);

} // namespace phlux::files
