#include "film/paged_array.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "errors.h"

namespace phlux::film {
namespace {

[[noreturn]] void fail(const char* what, int error) {
  throw WriteError(
      fmt::format("{}: a temporary file for the film {}: {}: name another folder by the variable TMPDIR",
                  ScratchFile::folder(), what, std::strerror(error)));
}

// Reads or writes, by ::pread or ::pwrite, `bytes` bytes at `offset`, by as many calls as that takes.
template<class Call, class Byte>
void transfer(Call call, int file, Byte* at, std::size_t bytes, std::uint64_t offset, const char* failure) {
  while (bytes > 0) {
    const ssize_t count = call(file, at, bytes, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(failure, count < 0 ? errno : EIO);
    at += count;
    bytes -= static_cast<std::size_t>(count);
    offset += static_cast<std::uint64_t>(count);
  }
}

} // namespace

const char* ScratchFile::folder() {
  const char* const named = std::getenv("TMPDIR");
  return named != nullptr && *named != '\0' ? named : "/var/tmp";
}

double ScratchFile::room() {
  struct statfs system {};
  if (::statfs(folder(), &system) != 0 || system.f_type == TMPFS_MAGIC || system.f_type == RAMFS_MAGIC)
    return 0.0;
  return static_cast<double>(system.f_bavail) * static_cast<double>(system.f_bsize);
}

ScratchFile::ScratchFile(std::uint64_t bytes) {
  std::string name = std::string(folder()) + "/phlux-film-XXXXXX";
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("cannot be made", errno);
  ::unlink(name.c_str());
  if (const int error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes)); error != 0) {
    ::close(descriptor_);
    fail(fmt::format("of {:.3g} GB has no room", 1e-9 * static_cast<double>(bytes)).c_str(), error);
  }
}

ScratchFile::~ScratchFile() {
  ::close(descriptor_);
}

void ScratchFile::read(void* to, std::size_t bytes, std::uint64_t offset) const {
  transfer(::pread, descriptor_, static_cast<char*>(to), bytes, offset, "cannot be read");
}

void ScratchFile::write(const void* from, std::size_t bytes, std::uint64_t offset) {
  transfer(::pwrite, descriptor_, static_cast<const char*>(from), bytes, offset, "cannot be written");
}

} // namespace phlux::film
