// The preview: a tone-mapped image.
#pragma once

#include <filesystem>
#include <string>

#include "files/image.h"

namespace phlux::files {

/// The bytes of an 8-bit sRGB PNG file, tone-mapped per channel by tone_map.h. Deterministic.
[[nodiscard]] std::string encode_png(const Image& image);

/// encode_png to a file. @throws WriteError
void write_png(const std::filesystem::path& file, const Image& image);

} // namespace phlux::files
