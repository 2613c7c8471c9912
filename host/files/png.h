// PNG files: the tone-mapped preview of an image, and what is drawn.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "files/canvas.h"
#include "files/image.h"

namespace phlux::files {

/// Draws channels R, G, B, tone-mapped by tone_map.h with that exposure, each pixel as a square of `zoom`
/// pixels.
void draw_image(Canvas& canvas, int left, int top, int zoom, const Image& image, float exposure);

/// The bytes of an 8-bit sRGB PNG file. Deterministic. @throws WriteError for more pixels than libpng writes
[[nodiscard]] std::string encode_png(const Canvas& canvas);

/// Writes channels R, G, B as such a file, tone-mapped by tone_map.h: radiance is multiplied by 2^stops, or
/// by the exposure of tone_map.h. Takes memory in proportion to the width alone. @throws WriteError
void encode_png(const Rows& rows, std::optional<double> stops, std::ostream& to);
[[nodiscard]] std::string encode_png(const Image& image, std::optional<double> stops = {});

/// encode_png to a file. @throws WriteError
void write_png(const std::filesystem::path& file, const Rows& rows, std::optional<double> stops = {});

} // namespace phlux::files
