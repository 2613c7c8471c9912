// The preview: a tone-mapped picture for people, where the EXR file is for programs.
#pragma once

#include <filesystem>
#include <string>

#include "files/image.h"

namespace phlux::files {

/// The bytes of an 8-bit sRGB PNG file: exposure, highlights and encoding of tone_map.h, per channel. The
/// same image gives the same bytes.
[[nodiscard]] std::string encode_png(const Image& image);

/// encode_png to a file. @throws WriteError
void write_png(const std::filesystem::path& file, const Image& image);

} // namespace phlux::files
