// Programs in the cache of a driver that caches them itself, as PoCL does. Such a driver loads what it finds:
// a damaged file ends the process, or gives wrong images. phlux therefore records what the driver keeps for
// each program.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace phlux::device {

/// A program in PoCL's cache.
struct DriverRecord {
  std::string mark;                           ///< a symbol of the program alone, which its file contains
  std::string folder;                         ///< below the cache's
  std::map<std::string, std::string> digests; ///< by file, below `folder`: size and hash_of() its bytes

  [[nodiscard]] std::string encode() const;
  /// Nothing for a text that encode() cannot have written; so `folder` is always one of PoCL's.
  [[nodiscard]] static std::optional<DriverRecord> decode(const std::string& text);
};

/// One program in PoCL's cache `folder`. Records are in its folder phlux, and are deleted with it.
class DriverCache {
public:
  /// Deletes what the cache has for this key if it differs from the record.
  DriverCache(std::filesystem::path folder, std::string key);

  /// Whether the cache has the program, as it was recorded or by this process.
  [[nodiscard]] bool has_program() const { return has_program_; }
  /// The program's text must end with this. It is new unless has_program(), so that PoCL finds no files that
  /// nothing is known about.
  [[nodiscard]] std::string definition_of_mark() const;
  /// After the program was built: it is recorded from now on.
  void built() const;

private:
  std::filesystem::path folder_;
  std::string key_, mark_;
  std::filesystem::file_time_type begin_; ///< PoCL has changed the program's folder since
  std::string program_folder_;            ///< where it is known
  bool has_program_ = false;
};

/// Records the programs that this process has built. To be called after the first launches, with which PoCL
/// compiles kernels; it is called at the end of the process as well. Failures are not reported: programs are
/// then built again.
void record_driver_cache();

} // namespace phlux::device
