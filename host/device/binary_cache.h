// Device binaries of built programs on disk. A cache that cannot be read or written costs time, never a
// render.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace phlux::device {

/// 128-bit FNV-1a of the bytes, as 32 hexadecimal digits. Tells files apart; no defence against an attacker.
/// http://www.isthe.com/chongo/tech/comp/fnv/
[[nodiscard]] std::string hash_of(const std::string& bytes);

/// $PHLUX_CACHE_DIR, else phlux/ under the user's cache folder, else a temporary one; empty when none can be
/// had.
[[nodiscard]] std::filesystem::path binary_cache_folder();

class BinaryCache {
public:
  /// A cache in `folder`. When that is empty or cannot be written: one that holds nothing, with one warning
  /// for the process.
  explicit BinaryCache(std::filesystem::path folder);

  /// The binary stored under `key`; nothing when there is none or the file is damaged.
  [[nodiscard]] std::optional<std::vector<unsigned char>> load(const std::string& key) const;
  /// Keeps the binary, replacing what is there; other processes see the old file or the new one, never a
  /// part.
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;

private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;
  std::filesystem::path folder_; // empty: no cache
};

} // namespace phlux::device
