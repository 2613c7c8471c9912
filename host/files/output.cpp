#include "files/output.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <ostream>
#include <random>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
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
  case ELOOP:
    return "it links to itself: name another";
  case ENOSPC:
  case EDQUOT:
  case EFBIG:
    return "make room, or name a place with more";
  case ENXIO:
  case EPIPE:
  case ETIMEDOUT:
    return "a program must read from it";
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

// An open file or folder, closed by the destructor.
class OpenFile {
public:
  OpenFile(const std::string& name, int flags) : descriptor_(::open(name.c_str(), flags | O_CLOEXEC, 0666)) {}
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
      if (written < 0 && (errno == EINTR || (errno == EAGAIN && wait()))) continue;
      if (written < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

  // Waits until the bytes are on the disk. False, with errno set, when they may not be.
  [[nodiscard]] bool sync() const {
    return ::fsync(descriptor_) == 0 || errno == EINVAL; // a file system that cannot sync
  }

  // Locks the file for as long as it is open, where the file system has locks.
  void lock() const { static_cast<void>(::flock(descriptor_, LOCK_EX)); }
  // Locks the file unless it is locked. Whether that succeeded.
  [[nodiscard]] bool try_to_lock() const { return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0; }

private:
  // Waits until a pipe's reader has made room.
  [[nodiscard]] bool wait() const {
    constexpr int patience = 60'000; // ms
    pollfd room{descriptor_, POLLOUT, 0};
    if (::poll(&room, 1, patience) != 0) return true; // write() will set errno
    errno = ETIMEDOUT;
    return false;
  }

  int descriptor_;
};

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// A temporary file is called like its target, with 12 random hexadecimal digits and ".part" after it.
constexpr std::size_t digits = 12;
constexpr std::string_view extension = ".part";

std::string random_digits() {
  std::random_device source;
  return fmt::format("{:06x}{:06x}", source() & 0xffffffU, source() & 0xffffffU);
}

// The beginning of the names of a file's temporary files, at most as long as file systems allow.
std::string beginning(const fs::path& target) {
  constexpr std::size_t longest = 255 - 1 - digits - extension.size();
  return target.filename().string().substr(0, longest) + '.';
}

bool is_temporary_of(const fs::path& target, const std::string& name) {
  const std::string begin = beginning(target);
  return name.size() == begin.size() + digits + extension.size() && name.starts_with(begin) &&
         name.ends_with(extension) &&
         name.find_first_not_of("0123456789abcdef", begin.size()) == begin.size() + digits;
}

// Removes the temporary files whose writers are dead: they no longer lock them.
void remove_stale(const fs::path& target) {
  std::error_code error;
  for (fs::directory_iterator each(folder_of(target), error), none; !error && each != none;
       each.increment(error)) {
    if (!is_temporary_of(target, each->path().filename().string())) continue;
    const OpenFile file(each->path(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK);
    if (file.is_open() && file.try_to_lock()) ::unlink(each->path().c_str());
  }
}

// Removed by the destructor unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    do { // again if remove_stale() of another process has deleted it before it was locked
      name_ = folder_of(target) / (beginning(target) + random_digits()).append(extension);
      file_.emplace(name_, O_WRONLY | O_CREAT | O_EXCL);
      if (!file_->is_open()) fail(target_, errno);
      file_->lock();
    } while (::access(name_.c_str(), F_OK) != 0);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!renamed_) ::unlink(name_.c_str());
  }
  void write_and_rename(const std::function<void(std::ostream&)>& write) {
    FileBuffer buffer(file_->descriptor());
    std::ostream stream(&buffer);
    write(stream);
    if (!stream.flush()) fail(target_, buffer.error() != 0 ? buffer.error() : EIO);
    if (!file_->sync() || ::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    renamed_ = true;
    // The rename lasts once the folder is on the disk; one that may not be read cannot be opened for that.
    const OpenFile folder(folder_of(target_), O_RDONLY | O_DIRECTORY);
    if (folder.is_open() && !folder.sync()) fail(target_, errno);
  }

private:
  fs::path target_, name_;
  std::optional<OpenFile> file_;
  bool renamed_ = false;
};

// The file that a link leads to, whether it exists or not; the path itself if it is no link.
fs::path followed(const fs::path& path) {
  constexpr int most_links = 40; // Linux's own limit
  fs::path target = path;
  std::error_code no_link;
  for (int links = 0; links <= most_links; ++links) {
    const fs::path next = fs::read_symlink(target, no_link);
    if (no_link) return target;
    target = target.parent_path() / next; // `next` alone if it is absolute
  }
  fail(path, ELOOP);
}

// The target of the rename. Symbolic links are followed, and so kept.
fs::path destination(const fs::path& path) {
  std::error_code error;
  if (path.empty()) fail(path, ENOENT);
  if (fs::is_directory(path, error)) fail(path, EISDIR);
  if (fs::exists(path, error) && ::access(path.c_str(), W_OK) != 0) fail(path, errno);
  return followed(path);
}

} // namespace

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw WriteError(
        fmt::format("{}: cannot be created: {}: choose another folder", folder.string(), error.message()));
  if (!std::filesystem::is_directory(folder))
    throw WriteError(fmt::format("{}: is not a folder: choose another name", folder.string()));
}

void check_writable(const fs::path& path) {
  if (!is_special(path)) {
    const fs::path target = destination(path);
    remove_stale(target);
    const TemporaryFile probe(target);
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
  const OpenFile file(path, O_WRONLY | O_NONBLOCK); // which fails for a pipe that nobody reads
  if (!file.is_open() || !file.write(stream.view())) fail(path, errno);
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file(path,
             [&](std::ostream& to) { to.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

fs::path elsewhere(const fs::path& path) {
  std::error_code none;
  const fs::path folder = fs::temp_directory_path(none); // empty if it does not exist: the working directory
  return folder / (path.stem().string() + '-' + random_digits()).append(path.extension().string());
}

bool same_file(const fs::path& a, const fs::path& b) {
  struct stat of_a {
  }, of_b{};
  const auto same = [&] { return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino; };
  const bool has_a = ::stat(a.c_str(), &of_a) == 0, has_b = ::stat(b.c_str(), &of_b) == 0;
  if (has_a || has_b) return has_a && has_b && same();
  const fs::path to_a = followed(a), to_b = followed(b);
  return to_a.filename() == to_b.filename() && ::stat(folder_of(to_a).c_str(), &of_a) == 0 &&
         ::stat(folder_of(to_b).c_str(), &of_b) == 0 && same();
}

} // namespace phlux::files
