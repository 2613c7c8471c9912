// The steps of a render after its last sample: what takes long is shown, and a signal ends what is not
// needed.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "cli/progress.h"
#include "clock.h"
#include "film/progress.h"

namespace phlux::cli {

/// Thrown out of a step that a signal ends.
struct StepInterrupted {};

/// How long steps go on after a signal, beginning when one of them first notices it.
class Patience {
public:
  explicit Patience(Clock::duration most) : most_(most) {}
  /// To be called once there has been a signal.
  [[nodiscard]] bool is_over() {
    const Clock::time_point now = Clock::now();
    if (!since_) since_ = now;
    return now - *since_ >= most_;
  }

private:
  Clock::duration most_;
  std::optional<Clock::time_point> since_;
};

class LastSteps {
public:
  /// `interrupted`: whether there has been a signal.
  LastSteps(bool quiet, std::function<bool()> interrupted)
      : display_(quiet, {}, {}), interrupted_(std::move(interrupted)) {}

  /// For a step that is done in any case. Both results are for the life of this object.
  [[nodiscard]] film::Progress needed(std::string what) {
    return [this, what = std::move(what)](double done) { display_.step(what, done); };
  }
  /// For a step that throws StepInterrupted when the patience is over.
  [[nodiscard]] film::Progress optional(std::string what, Patience& patience) {
    return [this, what = std::move(what), &patience](double done) {
      display_.step(what, done);
      if (interrupted_() && patience.is_over()) throw StepInterrupted();
    };
  }
  /// Erases what is shown.
  void clear() { display_.clear(); }

private:
  ProgressDisplay display_;
  std::function<bool()> interrupted_;
};

} // namespace phlux::cli
