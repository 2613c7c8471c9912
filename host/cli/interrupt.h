// SIGINT and SIGTERM as a question that the dispatch loop asks.
#pragma once

namespace phlux::cli {

inline constexpr int interrupted_exit_code = 130;

/// While one lives, the first SIGINT or SIGTERM only sets a flag; a second one ends the process at once. One
/// at a time.
class InterruptGuard {
public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] bool requested() const;
};

} // namespace phlux::cli
