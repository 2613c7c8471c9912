#define CATCH_CONFIG_EXTERNAL_INTERFACES // listeners, in Catch2 2
#include "cli/program.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <mutex>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "temporary_folder.h"

namespace {

// Arguments and output of the runs in the current test case.
class Record {
public:
  void forget() {
    const std::lock_guard lock(mutex_);
    runs_.clear();
  }
  void add(const Invocation& invocation, const Outcome& outcome) {
    std::ostringstream text;
    text << "phlux";
    for (const std::string& argument : invocation.arguments) text << ' ' << argument;
    text << "\n  exit code " << outcome.exit_code
         << ", standard error: " << (outcome.err.empty() ? "nothing\n" : "\n" + outcome.err);
    const std::lock_guard lock(mutex_);
    runs_.push_back(text.str());
  }
  void print() {
    const std::lock_guard lock(mutex_);
    for (const std::string& each : runs_) std::cerr << each;
  }

private:
  std::mutex mutex_;
  std::vector<std::string> runs_;
};

Record record;

// Prints every run of a failed test case, whichever assertion failed.
struct ShowRuns : Catch::TestEventListenerBase {
  using Catch::TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    Catch::TestEventListenerBase::testCaseStarting(info);
    record.forget();
  }
  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    if (!stats.totals.assertions.allOk()) record.print();
    Catch::TestEventListenerBase::testCaseEnded(stats);
  }
};
CATCH_REGISTER_LISTENER(ShowRuns)

void redirect(int descriptor, const std::string& file) {
  if (file == "closed") {
    ::close(descriptor);
    return;
  }
  int pipe[2];
  if (file == "broken pipe") {
    if (::pipe(pipe) != 0 || ::dup2(pipe[1], descriptor) < 0) ::_exit(126);
    ::close(pipe[0]);
    ::close(pipe[1]);
    return;
  }
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(126);
}

[[noreturn]] void become(const Invocation& invocation, const TemporaryFolder& streams) {
  redirect(STDOUT_FILENO, streams / "out");
  redirect(STDERR_FILENO, streams / "err");
  for (const auto& [descriptor, file] : invocation.streams) redirect(descriptor, file);
  if (invocation.ignores_hangup) std::signal(SIGHUP, SIG_IGN);
  if (::chdir(invocation.folder.c_str()) != 0) ::_exit(126);
  if (invocation.largest_file) {
    const rlimit limit{*invocation.largest_file, *invocation.largest_file};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(126);
    std::signal(SIGXFSZ, SIG_IGN); // its default action ends the program
  }
  if (invocation.address_space) {
    const rlimit limit{*invocation.address_space, *invocation.address_space};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) ::_exit(126);
  }
  for (const auto& [name, value] : invocation.environment) ::setenv(name.c_str(), value.c_str(), 1);
  std::vector<std::string> texts = invocation.launcher;
  texts.emplace_back(PHLUX_PROGRAM);
  texts.insert(texts.end(), invocation.arguments.begin(), invocation.arguments.end());
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

// Whether exec() has replaced this process's copy by the program and the program handles SIGINT. True if it
// has ended.
bool catches_interrupts(pid_t process) {
  const std::filesystem::path folder = "/proc/" + std::to_string(process);
  std::error_code ended;
  const std::filesystem::path program = std::filesystem::read_symlink(folder / "exe", ended);
  if (ended) return true;
  if (!std::filesystem::equivalent(program, PHLUX_PROGRAM)) return false;
  std::ifstream status(folder / "status");
  std::string word;
  while (status >> word && word != "SigCgt:") {
  }
  std::uint64_t caught = 0;
  status >> std::hex >> caught;
  return ((caught >> (SIGINT - 1)) & 1) != 0;
}

// A number that changes when the file is replaced.
ino_t version_of(const std::filesystem::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

void interrupt(pid_t process, const Invocation& invocation, ino_t version) {
  using namespace std::chrono_literals;
  const auto patience = std::chrono::steady_clock::now() + 60s;
  const auto is_time = [&] {
    siginfo_t info{};
    const bool ended = ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
                       info.si_pid == process;
    return ended || ((!invocation.launcher.empty() || catches_interrupts(process)) &&
                     (invocation.after_write.empty() || version_of(invocation.after_write) != version));
  };
  while (!is_time() && std::chrono::steady_clock::now() < patience) std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(*invocation.interrupt_after);
  ::kill(process, invocation.signal);
}

} // namespace

bool Outcome::is_one_line_error() const {
  // PoCL's clang writes this line to standard error itself, and takes no option against it.
  static const std::regex of_clang("^[0-9]+ errors? generated\\.\n");
  const std::string own = std::regex_replace(err, of_clang, "");
  return own.starts_with("phlux: ") && !own.starts_with("phlux: warning") && own.ends_with('\n') &&
         std::ranges::count(own, '\n') == 1;
}

Outcome run(const Invocation& invocation) {
  const TemporaryFolder streams;
  const ino_t version = version_of(invocation.after_write);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("cannot fork");
  if (process == 0) become(invocation, streams);
  if (invocation.interrupt_after) interrupt(process, invocation, version);
  int status = 0;
  if (::waitpid(process, &status, 0) != process) throw std::runtime_error("the program is lost");
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const Outcome outcome{exit_code, TemporaryFolder::read(streams / "out"),
                        TemporaryFolder::read(streams / "err")};
  record.add(invocation, outcome);
  return outcome;
}
