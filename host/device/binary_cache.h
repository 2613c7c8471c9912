// A cache of program binaries on disk. Its failures are never errors: programs are then built again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace phlux::device {

/// 128-bit FNV-1a of the bytes, as 32 hexadecimal digits; not secure against forgery.
/// http://www.isthe.com/chongo/tech/comp/fnv/
[[nodiscard]] std::string hash_of(const std::string& bytes);

/// $PHLUX_CACHE_DIR, else phlux/ in the user's cache folder, else a temporary folder; empty when all fail.
[[nodiscard]] std::filesystem::path binary_cache_folder();

class BinaryCache {
public:
  /// A cache in `folder`; when that is empty or not writable, an empty cache and one warning per process.
  explicit BinaryCache(std::filesystem::path folder);

  /// The binary stored under `key`; nothing when there is none or the file is damaged.
  [[nodiscard]] std::optional<std::vector<unsigned char>> load(const std::string& key) const;
  /// Stores the binary, replacing an earlier one; other processes see the old file or the whole new one.
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;

private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;
  std::filesystem::path folder_; // empty: no cache
};

} // namespace phlux::device
