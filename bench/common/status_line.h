// What a measurement that takes minutes shows while it runs.
#pragma once

#include <string>

#include "clock.h"

namespace phlux::bench {

/// "4:05", "1:02:03".
[[nodiscard]] std::string clock_text(double seconds);

/// One line of standard error that changes, on a terminal; elsewhere a plain line every ten seconds.
class StatusLine {
public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text);
  /// Takes the changing line away, for whatever comes next.
  void clear();

private:
  bool terminal_, shown_ = false;
  Clock::time_point next_;
};

} // namespace phlux::bench
