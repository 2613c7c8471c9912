// Python programs that this binary holds, run in a process beside this one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phlux::bench {

struct PythonOutcome {
  int exit_code = 127; ///< of the interpreter; 127: not started, 128 + the signal's number when one ended it
  std::string errors;
};

/// An interpreter that can import `module`.
[[nodiscard]] std::optional<std::string> find_python(std::string_view module);

/// Runs `program` with these arguments; what it prints is dropped, its errors are kept. @throws WriteError
/// when there are no pipes left
[[nodiscard]] PythonOutcome run_python(const std::string& interpreter,
                                       const std::vector<std::string>& arguments, std::string_view program);

} // namespace phlux::bench
