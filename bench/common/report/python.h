// Runs Python programs in a child process.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phlux::bench {

struct PythonOutcome {
  int exit_code = 127; ///< 127: not started; 128 + signal number if a signal ended it
  std::string errors;  ///< standard error
};

/// The first interpreter that can import `module`, if there is one.
[[nodiscard]] std::optional<std::string> find_python(std::string_view module);

/// Runs `program` with these arguments; discards its standard output and returns its standard error.
/// @throws WriteError if no pipe can be created
[[nodiscard]] PythonOutcome run_python(const std::string& interpreter,
                                       const std::vector<std::string>& arguments, std::string_view program);

} // namespace phlux::bench
