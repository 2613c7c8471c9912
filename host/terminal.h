// Text for the user. Text that a full disk, a closed terminal or a pipe without a reader does not accept is
// lost, without ending the program.
#pragma once

#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace phlux {

/// Prints to standard output, at once, so that the log of a long render has it. cli::run() reports a failure
/// at the end.
template<class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
  static_cast<void>(std::fflush(stdout));
}

/// Prints to standard error.
template<class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

} // namespace phlux
