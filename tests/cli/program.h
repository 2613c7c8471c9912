// Runs the built program: arguments in; exit code, output and errors out. A failed test case prints the
// arguments, exit code and standard error of its runs.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

struct Outcome {
  int exit_code = -1; ///< 128 + the signal's number when a signal ended it
  std::string out, err;

  /// Whether the errors are one line that begins with "phlux: " and is not a warning.
  [[nodiscard]] bool is_one_line_error() const;
};

struct Invocation {
  std::vector<std::string> arguments;
  std::filesystem::path folder;                   ///< where it runs
  std::map<std::string, std::string> environment; ///< on top of this process's
  /// Time from when the program handles SIGINT until `signal` is sent.
  std::optional<std::chrono::milliseconds> interrupt_after;
  /// Limit on the size of written files, in bytes.
  std::optional<std::size_t> largest_file = std::nullopt;
  /// Limit on its address space, in bytes.
  std::optional<std::size_t> address_space = std::nullopt;
  int signal = SIGINT;
  /// Sent once this file has been written; empty: as soon as it is handled.
  std::filesystem::path after_write = {};
  /// Where standard output (1) and error (2) go instead of to Outcome: a file, "closed" or "broken pipe".
  std::map<int, std::string> streams = {};
  bool ignores_hangup = false; ///< as under nohup
  /// A program and its arguments, to which the program and its own are added, such as mpirun. Signals are for
  /// it, once `after_write` has been written.
  std::vector<std::string> launcher = {};
};

/// Waits for the program to end. Standard output and error are not terminals.
[[nodiscard]] Outcome run(const Invocation& invocation);
