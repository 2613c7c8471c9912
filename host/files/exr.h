// OpenEXR files.
#pragma once

#include <filesystem>
#include <string>

#include "files/image.h"

namespace phlux::files {

/// The bytes of a scan-line EXR file, float32 channels, ZIP-compressed (lossless), with the attributes of
/// RenderInfo.
[[nodiscard]] std::string encode_exr(const Image& image);

/// encode_exr to a file. @throws WriteError
void write_exr(const std::filesystem::path& file, const Image& image);

/// Every channel of the first part as float32 (half and integer channels are converted). Missing attributes
/// keep RenderInfo's defaults.
/// @throws FileError when the file is missing, no EXR image, damaged, or has subsampled channels
[[nodiscard]] Image read_exr(const std::filesystem::path& file);

} // namespace phlux::files
