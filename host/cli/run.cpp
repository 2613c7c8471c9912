#include "cli/run.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <new>
#include <string>

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "cli/command_line.h"
#include "cli/spelling.h"
#include "errors.h"
#include "printable.h"

namespace phlux::cli {
namespace {

constexpr int defect_exit_code = 70; // EX_SOFTWARE of sysexits.h

// The text of a message, which may quote a file.
class PrintableText final : public spdlog::custom_flag_formatter {
public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& to) override {
    const std::string text = printable({message.payload.data(), message.payload.size()}, true);
    to.append(text.data(), text.data() + text.size());
  }
  [[nodiscard]] std::unique_ptr<spdlog::custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableText>();
  }
};

void set_up_log() {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("phlux"));
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableText>('*').set_pattern("phlux: %l: %*");
  spdlog::set_formatter(std::move(formatter));
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
