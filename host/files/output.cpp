#include "files/output.h"

#include <cerrno>
#include <cstring>
#include <ostream>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "errors.h"
#include "files/file_buffer.h"

namespace phlux::files {
namespace fs = std::filesystem;
namespace {

const char* remedy(int error) {
  switch (error) {
  case ENOENT:
  case ENOTDIR:
    return "make its folder, or name another";
  case EISDIR:
    return "name a file in it";
  case ENOSPC:
  case EDQUOT:
  case EFBIG:
    return "make room, or name a place with more";
  default:
    return "name a file in a folder that you may write to";
  }
}

[[noreturn]] void fail(const fs::path& path, int error) {
  throw WriteError(
      fmt::format("{}: cannot be written: {}: {}", path.string(), std::strerror(error), remedy(error)));
}

bool is_special(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

// A file open for writing, closed by the destructor.
class OpenFile {
public:
  OpenFile(const char* name, int flags) : descriptor_(::open(name, flags | O_WRONLY | O_CLOEXEC, 0666)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

  // False, with errno set, when not all bytes could be written.
  [[nodiscard]] bool write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

private:
  int descriptor_;
};

// Removed by the destructor unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const fs::path& target)
      : target_(target), name_(fmt::format("{}.{}.part", target.string(), ::getpid())),
        file_((::unlink(name_.c_str()), name_.c_str()), O_CREAT | O_EXCL) { // one left by a killed process
    if (!file_.is_open()) fail(target_, errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!renamed_) ::unlink(name_.c_str());
  }
  void write_and_rename(const std::function<void(std::ostream&)>& write) {
    FileBuffer buffer(file_.descriptor());
    std::ostream stream(&buffer);
    write(stream);
    if (!stream.flush()) fail(target_, buffer.error() != 0 ? buffer.error() : EIO);
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    renamed_ = true;
  }

private:
  fs::path target_;
  std::string name_;
  OpenFile file_;
  bool renamed_ = false;
};

// The target of the rename. Symbolic links are followed, and so kept.
fs::path destination(const fs::path& path) {
  std::error_code error;
  if (path.empty()) fail(path, ENOENT);
  if (fs::is_directory(path, error)) fail(path, EISDIR);
  if (fs::exists(path, error) && ::access(path.c_str(), W_OK) != 0) fail(path, errno);
  return fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
}

} // namespace

void check_writable(const fs::path& path) {
  if (!is_special(path)) {
    const TemporaryFile probe(destination(path));
  } else if (::access(path.c_str(), W_OK) != 0) {
    fail(path, errno);
  }
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (!is_special(path)) {
    TemporaryFile(destination(path)).write_and_rename(write);
    return;
  }
  std::ostringstream stream(std::ios::binary);
  write(stream);
  if (const OpenFile file(path.c_str(), 0); !file.is_open() || !file.write(stream.view())) fail(path, errno);
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file(path,
             [&](std::ostream& to) { to.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

} // namespace phlux::files
