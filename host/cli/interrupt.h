// Signals that end a render as a flag that the dispatch loop polls.
#pragma once

namespace phlux::cli {

inline constexpr int interrupted_exit_code = 130;

/// During its lifetime SIGINT, SIGTERM, SIGHUP (a closed terminal; not if nohup has it ignored) and SIGXCPU
/// only set a flag. A SIGINT or SIGTERM that comes two seconds or more after the first of these two ends the
/// process at once. There must be only one guard at a time.
class InterruptGuard {
public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] bool requested() const;
};

/// Lets writes to pipes without a reader and beyond a limit on the size of files fail; by default their
/// signals, SIGPIPE and SIGXFSZ, end the process.
void let_writes_fail();

} // namespace phlux::cli
