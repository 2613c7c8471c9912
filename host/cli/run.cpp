#include "cli/run.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "cli/command_line.h"
#include "cli/spelling.h"
#include "errors.h"

namespace phlux::cli {
namespace {

constexpr int defect_exit_code = 70; // EX_SOFTWARE of sysexits.h

void set_up_log() {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("phlux"));
  spdlog::set_pattern("phlux: %l: %v");
  spdlog::set_level(spdlog::level::warn);
}

// Prints the first line of the message; further lines, such as a compiler's log, only with --verbose.
int report(const std::string& error, int exit_code) {
  const std::string message = with_options(error);
  const std::size_t end = message.find('\n');
  fmt::print(stderr, "phlux: {}\n", message.substr(0, end));
  if (end != std::string::npos) spdlog::info("{}", message.substr(end + 1));
  return exit_code;
}

int run_command(int argc, char** argv) {
  const std::optional<Command> command = parse(argc, argv);
  const int exit_code = command ? (*command)() : 0;
  if (std::fflush(stdout) != 0) throw WriteError(fmt::format("standard output: {}", std::strerror(errno)));
  return exit_code;
}

} // namespace

int run(int argc, char** argv) {
  set_up_log();
  try {
    return run_command(argc, argv);
  } catch (const Error& error) {
    return report(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return report("out of memory: a smaller --size or scene needs less", defect_exit_code);
  } catch (const std::exception& error) {
    return report(fmt::format("internal error: {}", error.what()), defect_exit_code);
  }
}

} // namespace phlux::cli
