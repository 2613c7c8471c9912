// Atomic writes: to a temporary file in the same folder, which is renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

namespace phlux::files {

/// Creates `folder` and its parents if they do not exist. @throws WriteError
void make_folder(const std::filesystem::path& folder);

/// Checks before a long render that `path` can be written, by creating and removing the temporary file.
/// Removes temporary files of `path` that killed processes have left.
/// @throws WriteError
void check_writable(const std::filesystem::path& path);

/// Replaces `path` (or the target of a link) by what `write` writes; a reader sees the old file or the new
/// one, also after a power cut. The stream can seek; it takes no memory in proportion to the file, unless
/// that is not regular (/dev/null, a pipe with a reader), which is written to directly and at once.
/// @throws WriteError, leaving no temporary file behind, and what `write` throws
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// The same with these bytes.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A second place for what cannot be written to `path`: a new name like it in $TMPDIR, by default /tmp.
[[nodiscard]] std::filesystem::path elsewhere(const std::filesystem::path& path);

/// Whether two names are of one file, by device and inode. Of files that do not exist yet, those of their
/// folders and their names are compared. Links are followed.
[[nodiscard]] bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace phlux::files
