#include "cli/attempts.h"

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "cli/interrupt.h"
#include "cli/spelling.h"
#include "terminal.h"

namespace phlux::cli {

int Attempts::report(int otherwise) const {
  for (const Error& error : errors_) print_error(error.what());
  if (!interrupted_.empty())
    spdlog::warn("interrupted before these were done: {}", fmt::join(interrupted_, ", "));
  if (!errors_.empty()) return errors_.front().exit_code();
  return interrupted_.empty() ? otherwise : interrupted_exit_code;
}

void print_error(const std::string& message) {
  const std::string text = with_options(message);
  tell("phlux: {}\n", text.substr(0, text.find('\n')));
}

} // namespace phlux::cli
