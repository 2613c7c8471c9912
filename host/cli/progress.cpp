#include "cli/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "terminal.h"

namespace phlux::cli {
namespace {

constexpr double seconds_between_bars = 0.1;
constexpr double seconds_between_lines = 10.0;
constexpr std::size_t usual_columns = 80;
constexpr std::size_t narrowest_bar = 6, widest_bar = 32;

std::size_t terminal_columns() {
  winsize window{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return usual_columns;
  return window.ws_col;
}

std::string clock_text(double seconds) {
  constexpr double longest = 1e12; // 30,000 years
  const auto whole = static_cast<std::int64_t>(std::ceil(std::min(seconds, longest)));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// "[####    ] TEXT" in at most `columns`; the bar takes what the text leaves.
std::string bar_line(double fraction, const std::string& text, std::size_t columns) {
  constexpr std::size_t around_bar = 3;
  if (text.size() + around_bar + narrowest_bar > columns) return text.substr(0, columns);
  const std::size_t width = std::min(widest_bar, columns - text.size() - around_bar);
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
  return fmt::format("[{:<{}}] {}", std::string(filled, '#'), width, text);
}

// Whether standard error is a terminal that understands escape sequences.
bool can_erase_lines() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

} // namespace

double fraction_done(const render::Progress& progress, std::optional<double> time_limit,
                     std::optional<double> target_error, double error) {
  double fraction = 0.0;
  if (progress.samples_total && *progress.samples_total > 0.0)
    fraction = progress.samples_done / *progress.samples_total;
  if (time_limit) fraction = std::max(fraction, progress.seconds / *time_limit);
  if (target_error && std::isfinite(error))
    fraction = std::max(fraction, error > 0.0 ? std::pow(*target_error / error, 2) : 1.0);
  return std::clamp(fraction, 0.0, 1.0);
}

std::string progress_text(const render::Progress& progress, double fraction, double error) {
  std::string text = fmt::format("{:3.0f}%  ", std::floor(100.0 * fraction));
  text += progress.samples_total
              ? fmt::format("{:.0f}/{:.0f} samples", progress.samples_done, *progress.samples_total)
              : fmt::format("{:.0f} samples", progress.samples_done);
  if (progress.seconds > 0.0)
    text += fmt::format("  {:.3g} M paths/s", 1e-6 * static_cast<double>(progress.paths) / progress.seconds);
  if (std::isfinite(error)) text += fmt::format("  error {:.3g}%", 100.0 * error);
  if (fraction > 0.0 && fraction < 1.0)
    text += fmt::format("  {} left", clock_text(progress.seconds * (1.0 - fraction) / fraction));
  return text;
}

ProgressDisplay::ProgressDisplay(bool quiet, std::optional<double> time_limit,
                                 std::optional<double> target_error)
    : quiet_(quiet), terminal_(can_erase_lines()), time_limit_(time_limit), target_error_(target_error),
      next_update_(between_updates()), next_step_(Clock::now() + duration_of(next_update_)) {}

void ProgressDisplay::building_kernels() {
  if (!quiet_) show("building kernels");
}

void ProgressDisplay::update(const render::Progress& progress, const std::function<double()>& error) {
  if (quiet_ || progress.seconds < next_update_) return;
  next_update_ = progress.seconds + between_updates();
  const double error_so_far = error();
  const double fraction = fraction_done(progress, time_limit_, target_error_, error_so_far);
  const std::string text = progress_text(progress, fraction, error_so_far);
  show(terminal_ ? bar_line(fraction, text, terminal_columns() - 1) : text);
}

void ProgressDisplay::step(const std::string& what, double done) {
  const Clock::time_point now = Clock::now();
  if (quiet_ || now < next_step_) return;
  next_step_ = now + duration_of(between_updates());
  const std::string text = fmt::format("{:3.0f}%  {}", std::floor(100.0 * done), what);
  show(terminal_ ? bar_line(done, text, terminal_columns() - 1) : text);
}

double ProgressDisplay::between_updates() const {
  return terminal_ ? seconds_between_bars : seconds_between_lines;
}

void ProgressDisplay::clear() {
  if (line_is_shown_) tell("\r\x1b[K");
  line_is_shown_ = false;
}

void ProgressDisplay::show(const std::string& text) {
  if (!terminal_) {
    tell("phlux: {}\n", text);
    return;
  }
  tell("\r\x1b[K{}", text);
  std::fflush(stderr);
  line_is_shown_ = true;
}

} // namespace phlux::cli
