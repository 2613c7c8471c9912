#include "bench/common/report/python.h"

#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "errors.h"

extern char** environ;

namespace phlux::bench {
namespace {

// Debian's interpreter first: python3-matplotlib is installed for that one.
constexpr std::array<const char*, 2> interpreters = {"/usr/bin/python3", "python3"};

class Pipe {
public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw WriteError("no pipe to python3 can be created");
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  [[nodiscard]] int end(std::size_t i) const { return ends_[i]; }
  void close(std::size_t i) {
    if (ends_[i] >= 0) ::close(ends_[i]);
    ends_[i] = -1;
  }

private:
  std::array<int, 2> ends_{-1, -1}; // read end, write end
};

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return; // the program has exited early: its exit code tells
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> piece{};
  for (;;) {
    const ssize_t got = ::read(descriptor, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
}

// Runs a command with `input` on standard input; discards standard output, returns standard error.
PythonOutcome run(const std::vector<std::string>& command, std::string_view input) {
  Pipe to, from;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to.end(0), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, from.end(1), STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {};
  to.close(0);
  from.close(1);
  const auto previous = std::signal(SIGPIPE, SIG_IGN);
  write_all(to.end(1), input);
  std::signal(SIGPIPE, previous);
  to.close(1);
  PythonOutcome outcome;
  outcome.errors = read_all(from.end(0));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

} // namespace

std::optional<std::string> find_python(std::string_view module) {
  const std::string import = "import " + std::string(module);
  for (const char* interpreter : interpreters)
    if (run({interpreter, "-c", import}, "").exit_code == 0) return interpreter;
  return std::nullopt;
}

PythonOutcome run_python(const std::string& interpreter, const std::vector<std::string>& arguments,
                         std::string_view program) {
  std::vector<std::string> command = {interpreter, "-"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run(command, program);
}

} // namespace phlux::bench
