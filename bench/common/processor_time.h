// Processor time, which other programs do not lengthen.
#pragma once

#include <sys/resource.h>

namespace phlux::bench {

/// Seconds of all threads of this process, or of the calling thread (RUSAGE_THREAD).
inline double processor_seconds(int whose = RUSAGE_SELF) {
  rusage usage{};
  ::getrusage(whose, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace phlux::bench
