// A loop whose steps several threads do.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace phlux {

/// Calls work(step, thread) for each step from 0 to steps - 1, in up to `threads` threads: in this one, which
/// is thread 0, and in others, of which there are fewer if the system refuses some. Waits for them. Rethrows
/// an exception of `work`, after which some steps are left out.
template<class Work>
void in_parallel(std::size_t threads, std::size_t steps, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr exception;
  const auto run = [&](std::size_t thread) {
    try {
      for (std::size_t step = next++; step < steps; step = next++) work(step, thread);
    } catch (...) {
      next = steps;
      const std::lock_guard lock(mutex);
      exception = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t thread = 1; thread < threads && thread < steps; ++thread)
        others.emplace_back(run, thread);
    } catch (const std::system_error&) { // no thread
    }
    run(0);
  }
  if (exception) std::rethrow_exception(exception);
}

} // namespace phlux
