// Files that appear whole or not at all: written to a temporary name in the same folder and renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace phlux::files {

/// Finds out, before hours of rendering, whether `path` could be written, by creating and removing the
/// temporary file.
/// @throws WriteError
void check_writable(const std::filesystem::path& path);

/// Replaces `path` (or what it links to) by `bytes`; a reader sees the old file or the new one. What is not a
/// regular file (/dev/null, a pipe) is written to as it is.
/// @throws WriteError, leaving no temporary file behind
void write_file(const std::filesystem::path& path, std::string_view bytes);

} // namespace phlux::files
