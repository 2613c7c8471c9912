#include "bench/common/status_line.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr std::chrono::milliseconds between_changes{100};
constexpr std::chrono::seconds between_lines{10};

std::size_t terminal_columns() {
  constexpr std::size_t usual = 80;
  winsize window{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return usual;
  return window.ws_col;
}

} // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

StatusLine::StatusLine()
    : terminal_(::isatty(STDERR_FILENO) == 1),
      next_(terminal_ ? Clock::now() : Clock::now() + between_lines) {}

void StatusLine::show(const std::string& text) {
  if (Clock::now() < next_) return;
  next_ = Clock::now() + (terminal_ ? Clock::duration(between_changes) : Clock::duration(between_lines));
  if (!terminal_) {
    tell("phlux: {}\n", text);
    return;
  }
  tell("\r\x1b[K{}", text.substr(0, terminal_columns() - 1));
  std::fflush(stderr);
  shown_ = true;
}

void StatusLine::clear() {
  if (shown_) tell("\r\x1b[K");
  shown_ = false;
}

} // namespace phlux::bench
