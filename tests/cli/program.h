// The built program as a user runs it: arguments in, exit code, output and errors out. A test case that fails
// shows what the program's runs in it were asked, ended with and wrote to standard error.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

struct Outcome {
  int exit_code = -1; ///< 128 + the signal's number when a signal ended it
  std::string out, err;

  /// The errors are one line that begins with "phlux: " and is no warning.
  [[nodiscard]] bool is_one_line_error() const;
};

struct Invocation {
  std::vector<std::string> arguments;
  std::filesystem::path folder;                   ///< where it runs
  std::map<std::string, std::string> environment; ///< on top of this process's
  /// SIGINT is sent that long after the program is ready for it.
  std::optional<std::chrono::milliseconds> interrupt_after;
  /// No file of more bytes can be written.
  std::optional<std::size_t> largest_file = std::nullopt;
};

/// Waits for its end. Standard output and error are no terminals.
[[nodiscard]] Outcome run(const Invocation& invocation);
