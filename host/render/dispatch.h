// Shares the work of a render among processors, and repeats what a failed one has not finished.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clock.h"
#include "render/error_target.h"
#include "render/processor.h"
#include "render/render.h"

namespace phlux::render {

/// A failure of a device, after which its launches are repeated.
struct Failure {
  std::string text;
  bool memory_is_short = false; ///< smaller launches may succeed
  bool for_good = false;        ///< trying again is useless
};

/// Of the exception that is being handled; nothing if it is another one.
[[nodiscard]] std::optional<Failure> current_failure();

/// Waits for Settings::pause_seconds, the time that a driver may need to reset a device that has failed.
void pause(const Settings& settings);

/// A processor that fails is tried again, once after a pause, and with ever smaller launches where memory is
/// short; then it is given up. In both cases others may take its launches. Launches are added to the film in
/// the order of the schedule, so that the film is the same, bit for bit, with any number of like processors,
/// and after failures. The result of a launch that ends before an earlier one is kept until that one is
/// added. While too many are kept, the only launches that begin are those of a failed processor, which are
/// repeated.
class DispatchLoop {
public:
  /// Up to `folding_threads` threads add a launch to the film.
  DispatchLoop(const Settings& settings, film::Film& film, const Events& events, const RenderState& from,
               std::size_t folding_threads = 1);

  /// Runs the processors, each in a thread, until the work is done or ended, or all have failed. Reports
  /// progress after each launch. @throws what is no failure of a device, such as an exception of `events`
  void run(const std::vector<Processor*>& processors);

  /// The state that belongs to the film.
  [[nodiscard]] RenderState state() const;
  /// Why all processors are given up, with work left; empty if they are not.
  [[nodiscard]] const std::string& failure() const { return failure_; }

private:
  void run(Processor& processor);
  bool step(Processor& processor);
  bool take(Processor& processor);
  bool wait_for_more();
  [[nodiscard]] bool is_finished();
  [[nodiscard]] bool all_idle() const;
  [[nodiscard]] bool may_take() const;
  [[nodiscard]] bool is_next(const Launch& launch) const;
  void collect(Processor& processor);
  void fold(LaunchResult& result);
  bool recover(Processor& processor, const Failure& failure, int failures);
  void give_up(const std::string& what);
  void give_back(const Processor& processor);
  void end();
  [[nodiscard]] bool report() const;
  [[nodiscard]] bool precise_enough() { return target_ && target_->reached(film_, counts_.paths); }
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] std::int64_t paths_left() const;
  [[nodiscard]] double seconds() const { return seconds_before_ + seconds_since(begin_); }

  const Settings& settings_;
  film::Film& film_;
  const Events& events_;
  Clock::time_point begin_;
  double seconds_before_;
  bool open_ended_;
  std::optional<ErrorTarget> target_;
  std::mutex mutex_; // of the members below and the film
  std::condition_variable changed_;
  Schedule schedule_;
  std::map<const Processor*, std::deque<Launch>> in_flight_;
  std::map<Launch, LaunchResult, decltype(&precedes)> early_{&precedes}; // wait for their turn
  std::size_t most_early_ = 0;
  ResultFolder folder_;
  Counts counts_;
  std::uint64_t started_paths_;
  bool ended_ = false;
  std::size_t given_up_ = 0; // processors
  std::string last_failure_, failure_;
};

} // namespace phlux::render
