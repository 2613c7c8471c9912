#include "cli/interrupt.h"

#include <array>
#include <csignal>
#include <ctime>

namespace phlux::cli {
namespace {

constexpr std::array ending = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};

volatile std::sig_atomic_t interrupted = 0;
volatile std::time_t first_request = 0; // by SIGINT or SIGTERM; 0: none

// A second SIGINT or SIGTERM ends the program at once, unless it follows within two seconds: one keystroke
// can arrive twice, from the terminal and from a wrapper program that passes it on. The others repeat by
// themselves: shells and session managers pass SIGHUP on, and SIGXCPU comes every second.
extern "C" void note_interrupt(int signal) {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now); // async-signal-safe
  interrupted = 1;
  if (signal != SIGINT && signal != SIGTERM) return;
  if (first_request == 0) first_request = now.tv_sec;
  if (now.tv_sec - first_request >= 2) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

} // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  first_request = 0;
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART; // drivers need not expect EINTR
  for (const int signal : ending) {
    struct sigaction before {};
    sigaction(signal, &action, &before);
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) sigaction(signal, &before, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : ending) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler == note_interrupt) std::signal(signal, SIG_DFL);
  }
}

bool InterruptGuard::requested() const {
  return interrupted != 0;
}

void let_writes_fail() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

} // namespace phlux::cli
