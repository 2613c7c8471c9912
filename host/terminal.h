// Text for the user. Text that a full disk, a closed terminal or a pipe without a reader does not accept is
// lost, without ending the program.
#pragma once

#include <cerrno>
#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace phlux {

/// errno of the first failure of say(); 0 if there was none. cli::run() reports it at the end.
inline int say_errno = 0;

/// Prints to standard output, at once, so that the log of a long render has it.
template<class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  const bool printed =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!printed && say_errno == 0) say_errno = errno;
}

/// Prints to standard error.
template<class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

} // namespace phlux
