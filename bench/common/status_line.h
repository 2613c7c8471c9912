// Progress of a long measurement, on standard error.
#pragma once

#include <string>

#include "clock.h"

namespace phlux::bench {

/// Minutes and seconds, or hours, minutes and seconds: "4:05", "1:02:03". Rounded up to whole seconds.
[[nodiscard]] std::string clock_text(double seconds);

/// On a terminal, one line that is updated ten times per second at most; elsewhere, a new line every ten
/// seconds.
class StatusLine {
public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text);
  /// Erases the line. Needed before other output to the terminal.
  void clear();

private:
  bool terminal_, shown_ = false;
  Clock::time_point next_;
};

} // namespace phlux::bench
