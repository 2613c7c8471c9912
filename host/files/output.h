// Atomic writes: to a temporary file in the same folder, which is renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace phlux::files {

/// Checks before a long render that `path` can be written, by creating and removing the temporary file.
/// @throws WriteError
void check_writable(const std::filesystem::path& path);

/// Replaces `path` (or the target of a link) by `bytes`; a reader sees the old file or the new one. A file
/// that is not regular (/dev/null, a pipe) is written to directly.
/// @throws WriteError, leaving no temporary file behind
void write_file(const std::filesystem::path& path, std::string_view bytes);

} // namespace phlux::files
