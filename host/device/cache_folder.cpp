#include "device/cache_folder.h"

#include <cerrno>
#include <cstdlib>
#include <mutex>

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace phlux::device {

namespace fs = std::filesystem;

namespace {

std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

// Opens a new file that is gone when it is closed, or -1 and errno. Its name is removed at once, so that it
// is not left behind by a process that is killed; what such a one leaves in between is in no other's way.
int nameless_file(const fs::path& folder) {
  std::string name = (folder / ".probe-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) unlink(name.c_str());
  return file;
}

// Whether the folder has room for what PoCL writes for several programs.
bool has_room(const fs::path& folder) {
  constexpr double least = 16 << 20; // bytes
  constexpr off_t probed = 1 << 20;  // a quota shows only when it is met
  struct statvfs of_folder {};
  if (statvfs(folder.c_str(), &of_folder) == 0 &&
      static_cast<double>(of_folder.f_bavail) * static_cast<double>(of_folder.f_frsize) < least)
    return false;
  const int file = nameless_file(folder);
  const int error = file < 0 ? errno : posix_fallocate(file, 0, probed);
  if (file >= 0) close(file);
  return error != ENOSPC && error != EDQUOT;
}

void choose_pocl_cache() {
  fs::path wanted;
  if (auto given = environment("POCL_CACHE_DIR")) {
    wanted = *given;
  } else if (auto user = user_cache_folder("pocl/kcache")) { // PoCL's own default
    wanted = *user;
  }
  const bool writable = !wanted.empty() && writable_folder(wanted);
  if (writable && has_room(wanted)) {
    setenv("POCL_CACHE_DIR", wanted.c_str(), 1);
    return;
  }
  const auto temporary = temporary_cache_folder("pocl");
  if (!temporary || !has_room(*temporary)) {
    spdlog::warn("no writable folder with 16 MB of room for PoCL's kernel cache: set POCL_CACHE_DIR to one");
    return;
  }
  if (!wanted.empty())
    spdlog::warn("PoCL's kernel cache {} {}: using {}", wanted.string(),
                 writable ? "has no room" : "is not writable", temporary->string());
  setenv("POCL_CACHE_DIR", temporary->c_str(), 1);
}

} // namespace

std::optional<fs::path> user_cache_folder(const std::string& name) {
  if (auto cache = environment("XDG_CACHE_HOME")) return fs::path(*cache) / name;
  if (auto home = environment("HOME")) return fs::path(*home) / ".cache" / name;
  return std::nullopt;
}

bool writable_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  const int file = nameless_file(folder);
  if (file < 0) return false;
  close(file);
  return true;
}

std::optional<fs::path> temporary_cache_folder(const std::string& name) {
  std::error_code failed;
  const fs::path temporary = fs::temp_directory_path(failed);
  if (failed) return std::nullopt;
  const fs::path own = temporary / fmt::format("phlux-{}", getuid());
  mkdir(own.c_str(), 0700);
  // Binaries from a folder of another user must not be run.
  struct stat found {};
  if (lstat(own.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != getuid() ||
      (found.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    return std::nullopt;
  fs::path folder = own / name;
  if (!writable_folder(folder)) return std::nullopt;
  return folder;
}

void prepare_pocl_cache() {
  static std::once_flag once;
  std::call_once(once, choose_pocl_cache);
}

} // namespace phlux::device
