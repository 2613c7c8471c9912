// OpenEXR files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

#include "files/image.h"

namespace phlux::files {

/// Numbers of values that are NaN or infinite, by channel; no channel with none.
using NonFinite = std::map<std::string, std::uint64_t>;

/// Writes a scan-line EXR file, float32 channels, ZIP-compressed (lossless), with the attributes of
/// RenderInfo. The stream must be able to seek.
NonFinite encode_exr(const Rows& rows, const RenderInfo& info, std::ostream& to);

/// The bytes of a scan-line EXR file, float32 channels, ZIP-compressed (lossless), with the attributes of
/// RenderInfo.
[[nodiscard]] std::string encode_exr(const Image& image);

/// encode_exr to a file. @throws WriteError
NonFinite write_exr(const std::filesystem::path& file, const Rows& rows, const RenderInfo& info);
NonFinite write_exr(const std::filesystem::path& file, const Image& image);

/// The channels R, G, B, variance.R, .G, .B and reliability of the first part as float32 (half and integer
/// channels are converted). Missing attributes, and numbers that are not finite, keep RenderInfo's defaults.
/// Memory is bounded by 256 MiB and 2064 times the file's size; time is linear in that.
/// @throws FileError when the file is missing, not regular, no EXR image, damaged, or has subsampled
/// channels, or if its header claims more than such a file can hold
[[nodiscard]] Image read_exr(const std::filesystem::path& file);

} // namespace phlux::files
