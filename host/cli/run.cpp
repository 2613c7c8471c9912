#include "cli/run.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <new>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "cli/attempts.h"
#include "cli/command_line.h"
#include "cli/interrupt.h"
#include "cli/spelling.h"
#include "cli/work.h"
#include "cluster/group.h"
#include "errors.h"
#include "printable.h"
#include "terminal.h"

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

// Prints an error; lines after the first, such as a compiler's log, only with --verbose.
int report(const std::string& error, int exit_code) {
  if (is_worker()) return exit_code; // process 0 says it
  print_error(error);
  if (const std::size_t end = error.find('\n'); end != std::string::npos)
    spdlog::info("{}", with_options(error.substr(end + 1)));
  return exit_code;
}

// A file opened in the place of a closed standard stream would receive what is printed.
void keep_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY); // takes the smallest free number
}

// Several processes would write the same files.
void require_one_process(int argc, char** argv) {
  const cluster::Started started = cluster::started();
  const std::string command = argc > 1 ? argv[1] : "";
  for (const char* const alone : {"bench", "merge", "verify", "compare", "view", "devices"})
    if (started.processes > 1 && command == alone)
      throw UsageError(fmt::format(
          "{} has started {} processes, but only phlux render can use several: start phlux {} alone",
          started.by, started.processes, command));
}

int run_command(int argc, char** argv) {
  require_one_process(argc, argv);
  const std::optional<Command> command = parse(argc, argv);
  const int exit_code = command ? (*command)() : 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  const int reason = say_errno != 0 ? say_errno : errno;
  const WriteError error(fmt::format("standard output: cannot be written: {}", std::strerror(reason)));
  return report(error.what(), exit_code == 0 ? error.exit_code() : exit_code);
}

} // namespace

int run(int argc, char** argv) {
  keep_standard_streams();
  let_writes_fail();
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
