#include "cli/interrupt.h"

#include <csignal>
#include <ctime>

namespace phlux::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;
volatile std::time_t first_signal = 0;

// A second signal ends the program at once, unless it follows within two seconds: one keystroke can arrive
// twice, from the terminal and from a wrapper program that passes it on.
extern "C" void note_interrupt(int signal) {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now); // async-signal-safe
  if (interrupted == 0) first_signal = now.tv_sec;
  interrupted = 1;
  if (now.tv_sec - first_signal >= 2) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

} // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART; // drivers need not expect EINTR
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::requested() const {
  return interrupted != 0;
}

} // namespace phlux::cli
