// Cache folders: of phlux's kernel binaries and of PoCL.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace phlux::device {

/// $XDG_CACHE_HOME/name, else $HOME/.cache/name; nothing when neither variable is set.
[[nodiscard]] std::optional<std::filesystem::path> user_cache_folder(const std::string& name);

/// Whether the folder exists or was created, and a file could be created in it.
[[nodiscard]] bool writable_folder(const std::filesystem::path& folder);

/// A folder in the system's temporary one that only this user can write to; nothing when there can be none.
[[nodiscard]] std::optional<std::filesystem::path> temporary_cache_folder(const std::string& name);

/// Sets POCL_CACHE_DIR, once, to a writable folder with room for several programs, without which PoCL 3.1
/// finds no device. Must be called before the first OpenCL call of the process.
void prepare_pocl_cache();

} // namespace phlux::device
