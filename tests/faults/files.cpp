#include "faults/files.h"

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <mutex>
#include <random>
#include <sstream>

#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <sys/types.h>
#include <unistd.h>

namespace faults {
namespace {

class Plan {
public:
  Plan() {
    const char* text = std::getenv("PHLUX_FILE_FAULTS");
    if (text == nullptr) return;
    unsigned seed = 0;
    std::istringstream words(text);
    words >> seed >> probability_ >> folder_;
    random_.seed(seed);
  }
  void set(unsigned seed, double probability, const std::string& folder) {
    const std::lock_guard lock(mutex_);
    random_.seed(seed);
    probability_ = probability;
    folder_ = folder;
    struck_ = 0;
  }
  // Whether a call for this file is to fail; sets errno.
  bool strikes(const std::string& file) {
    const std::lock_guard lock(mutex_);
    if (folder_.empty() || !file.starts_with(folder_)) return false;
    if (std::uniform_real_distribution<>()(random_) >= probability_) return false;
    ++struck_;
    errno = random_() % 2 == 0 ? ENOSPC : EIO;
    return true;
  }
  long struck() {
    const std::lock_guard lock(mutex_);
    return struck_;
  }

private:
  std::mutex mutex_;
  std::mt19937 random_;
  double probability_ = 0;
  std::string folder_;
  long struck_ = 0;
};

// Never destroyed: files are written while the process ends.
Plan& plan() {
  static Plan& only = *new Plan;
  return only;
}

std::string absolute(const char* name) {
  if (name[0] == '/') return name;
  char folder[PATH_MAX];
  return ::getcwd(folder, sizeof folder) == nullptr ? std::string() : std::string(folder) + '/' + name;
}

std::string file_of(int descriptor) {
  char name[PATH_MAX];
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = ::readlink(link.c_str(), name, sizeof name);
  return length > 0 ? std::string(name, static_cast<std::size_t>(length)) : std::string();
}

template<class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

} // namespace

void plan_file_faults(unsigned seed, double probability, const std::string& folder) {
  plan().set(seed, probability, folder);
}

long file_faults() {
  return plan().struck();
}

} // namespace faults

using faults::next;
using faults::plan;

extern "C" int open(const char* name, int flags, ...) {
  static auto* const real = next<int(const char*, int, ...)>("open");
  std::va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_ACCMODE) != O_RDONLY && plan().strikes(faults::absolute(name))) return -1;
  return real(name, flags, mode);
}

extern "C" ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  static auto* const real = next<ssize_t(int, const void*, std::size_t)>("write");
  if (descriptor <= STDERR_FILENO || !plan().strikes(faults::file_of(descriptor)))
    return real(descriptor, bytes, count);
  const int error = errno;
  static_cast<void>(real(descriptor, bytes, count / 2));
  errno = error;
  return -1;
}

extern "C" int fsync(int descriptor) {
  static auto* const real = next<int(int)>("fsync");
  return plan().strikes(faults::file_of(descriptor)) ? -1 : real(descriptor);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  static auto* const real = next<int(const char*, const char*)>("rename");
  return plan().strikes(faults::absolute(to)) ? -1 : real(from, to);
}
