// Folders for what may be thrown away: phlux's kernel binaries and PoCL's own cache.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace phlux::device {

/// $XDG_CACHE_HOME/name, else $HOME/.cache/name; nothing when neither variable is set.
[[nodiscard]] std::optional<std::filesystem::path> user_cache_folder(const std::string& name);

/// True when the folder exists, or could be made, and a file could be written into it just now.
[[nodiscard]] bool writable_folder(const std::filesystem::path& folder);

/// A private folder under the system's temporary one that no other user can have made. Nothing when that
/// fails too.
[[nodiscard]] std::optional<std::filesystem::path> temporary_cache_folder(const std::string& name);

/// Sees to it, once, that POCL_CACHE_DIR names a folder that PoCL can write: with one that it cannot,
/// PoCL 3.1 finds no device. Must be called before the first OpenCL call of the process.
void prepare_pocl_cache();

} // namespace phlux::device
