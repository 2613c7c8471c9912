// SIGINT and SIGTERM as a flag that the dispatch loop polls.
#pragma once

namespace phlux::cli {

inline constexpr int interrupted_exit_code = 130;

/// During its lifetime the first SIGINT or SIGTERM only sets a flag; a second one ends the process at once.
/// There must be only one at a time.
class InterruptGuard {
public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] bool requested() const;
};

} // namespace phlux::cli
