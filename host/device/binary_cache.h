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

class BinaryCache {
public:
  /// In $PHLUX_CACHE_DIR, else phlux/ under the user's cache folder, else a temporary one. None of them
  /// writable: a cache that holds nothing, with one warning for the process.
  BinaryCache();

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
