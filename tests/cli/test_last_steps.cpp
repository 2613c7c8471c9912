// Tests of the steps after the last sample of a render: signals, failures, and the preview.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <catch2/catch.hpp>

#include "cli/attempts.h"
#include "cli/interrupt.h"
#include "errors.h"
#include "files/png.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace std::chrono_literals;

TEST_CASE("A signal ends a step once the patience is over, unless the step is needed") {
  bool signal = false;
  cli::LastSteps steps(true, [&] { return signal; });
  cli::Patience none(0s), enough(1h);
  const film::Progress hasty = steps.optional("a step", none), patient = steps.optional("a step", enough),
                       needed = steps.needed("a step");
  CHECK_NOTHROW(hasty(0.5));
  signal = true;
  CHECK_THROWS_AS(hasty(0.5), cli::StepInterrupted);
  CHECK_NOTHROW(patient(0.5));
  CHECK_NOTHROW(needed(0.5));
}

TEST_CASE("A SIGTERM well after SIGHUP is the first request to end, and does not end the process at once") {
  const cli::InterruptGuard guard;
  std::raise(SIGHUP);
  CHECK(guard.requested());
  std::this_thread::sleep_for(2100ms); // a second SIGTERM would end it now
  std::raise(SIGTERM);
}

TEST_CASE("Steps that a signal ended are an interruption, failures come first") {
  cli::Attempts attempts;
  attempts("one", [] {});
  CHECK(attempts.report(0) == 0);
  attempts("two", [] { throw cli::StepInterrupted(); });
  CHECK(attempts.report(0) == cli::interrupted_exit_code);
  attempts("three", [] { throw WriteError("three: cannot be written"); });
  CHECK(attempts.report(0) == 5);
}

TEST_CASE("A picture whose writing is ended leaves the earlier file") {
  const TemporaryFolder folder;
  folder.write("a.png", "earlier");
  files::Image image{.width = 3, .height = 5, .channels = {}, .info = {}};
  for (const char* name : files::radiance_names) image.channels[name].assign(15, 1.0F);
  const auto end = [](double done) {
    if (done > 0.5) throw cli::StepInterrupted();
  };
  CHECK_THROWS_AS(files::write_png(folder / "a.png", files::with_progress(files::rows_of(image), end), 0.0),
                  cli::StepInterrupted);
  CHECK(TemporaryFolder::read(folder / "a.png") == "earlier");
  CHECK(folder.names() == std::set<std::string>{"a.png"});
}
