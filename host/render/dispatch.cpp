#include "render/dispatch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::render {
namespace {

// A failure while a launch is added to the film, which then has a part of it.
struct FilmLost : Error {
  explicit FilmLost(const std::string& why)
      : Error(4, fmt::format("the film is lost: {}: resume from an earlier checkpoint", why)) {}
};

// Whether the error of a call may be due to too little memory.
bool is_memory_short(cl_int code) {
  return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_RESOURCES ||
         code == CL_OUT_OF_HOST_MEMORY || code == CL_INVALID_BUFFER_SIZE;
}

void add(const Counts& counts, Counts& to) {
  to.paths += counts.paths;
  to.rays += counts.rays;
  to.shadow_rays += counts.shadow_rays;
  to.nonfinite += counts.nonfinite;
  if (!to.first_nonfinite) to.first_nonfinite = counts.first_nonfinite;
}

} // namespace

std::optional<Failure> current_failure() {
  try {
    throw;
  } catch (const MemoryShort& error) {
    return Failure{error.what(), true};
  } catch (const ProcessorLost& error) {
    return Failure{error.what(), false, true};
  } catch (const DeviceError& error) {
    return Failure{error.what(), false};
  } catch (const cl::Error& error) {
    return Failure{device::describe(error), is_memory_short(error.err())};
  } catch (const std::bad_alloc&) {
    return Failure{"no memory left for the results of a launch", true};
  } catch (...) {
    return std::nullopt;
  }
}

void pause(const Settings& settings) {
  std::this_thread::sleep_for(std::chrono::duration<double>(settings.pause_seconds));
}

DispatchLoop::DispatchLoop(const Settings& settings, film::Film& film, const Events& events,
                           const RenderState& from, std::size_t folding_threads)
    : settings_(settings), film_(film), events_(events), begin_(Clock::now()),
      seconds_before_(from.seconds_render), open_ended_(settings.time_limit || settings.target_error),
      schedule_(static_cast<std::int64_t>(film.pixels().size()),
                open_ended_ ? std::nullopt : std::optional<std::int64_t>(settings.samples_per_pixel),
                from.position, samples_point_sets(settings) ? Blocks::of_point_sets : Blocks::of_independent,
                settings::most_samples - settings.first_sample),
      folder_(static_cast<std::int64_t>(film.pixels().size()), settings.techniques, folding_threads),
      counts_(from), started_paths_(from.paths) {
  if (settings.target_error) target_.emplace(*settings.target_error, film.pixels().size());
  ended_ = from.paths > 0 && precise_enough();
}

void DispatchLoop::run(const std::vector<Processor*>& processors) {
  constexpr std::size_t most_early_each = 2;
  most_early_ = most_early_each * processors.size();
  std::vector<std::exception_ptr> exceptions(processors.size());
  const auto run_one = [&](std::size_t i) {
    try {
      run(*processors[i]);
    } catch (...) {
      exceptions[i] = std::current_exception();
      end();
    }
  };
  {
    std::vector<std::jthread> others; // the first processor is for this thread
    for (std::size_t i = 1; i < processors.size(); ++i) {
      try {
        others.emplace_back(run_one, i);
      } catch (const std::system_error& error) {
        const std::lock_guard lock(mutex_);
        give_up(fmt::format("{}: no thread for it: {}", processors[i]->name(), error.what()));
      }
    }
    run_one(0);
  }
  for (const std::exception_ptr& exception : exceptions)
    if (exception) std::rethrow_exception(exception);
  if (given_up_ == processors.size() && !is_over()) failure_ = last_failure_ + ": no device is left";
}

// Runs one processor.
void DispatchLoop::run(Processor& processor) {
  bool begun = false;
  int failures = 0; // in a row
  while (true) {
    try {
      if (!begun) processor.begin(settings_);
      begun = true;
      while (!processor.is_ready())
        if (is_finished()) return;
      if (!step(processor)) return;
      failures = 0;
    } catch (...) {
      const std::optional<Failure> failure = current_failure();
      if (!failure) throw;
      if (!recover(processor, *failure, ++failures)) return;
    }
  }
}

// Keeps the processor busy and finishes one launch. False when the work is done or ended.
bool DispatchLoop::step(Processor& processor) {
  do {
    while (processor.in_flight() < processor.most_in_flight() && take(processor)) {
    }
  } while (processor.in_flight() == 0 && wait_for_more());
  if (processor.in_flight() == 0) return false;
  processor.settle();
  const std::lock_guard lock(mutex_);
  collect(processor);
  if (!ended_) ended_ = precise_enough() || !report();
  changed_.notify_all();
  return true;
}

// Adds the oldest launch to the film, and the early ones whose turn it is then; or keeps it.
void DispatchLoop::collect(Processor& processor) {
  std::deque<Launch>& launches = in_flight_[&processor];
  if (is_next(launches.front())) {
    fold(processor.result());
    processor.release();
  } else {
    early_.emplace(launches.front(), processor.detach());
  }
  launches.pop_front();
  while (!early_.empty() && is_next(early_.begin()->first)) {
    fold(early_.begin()->second);
    early_.erase(early_.begin());
  }
}

void DispatchLoop::fold(LaunchResult& result) try {
  add(folder_.fold(result, film_), counts_);
} catch (const std::exception& error) {
  throw FilmLost(error.what());
}

// Whether all launches before it are on the film.
bool DispatchLoop::is_next(const Launch& launch) const {
  const auto none_precedes = [&](const std::deque<Launch>& launches) {
    return std::ranges::none_of(launches, [&](const Launch& other) { return precedes(other, launch); });
  };
  return none_precedes(schedule_.missing()) &&
         std::ranges::all_of(in_flight_, [&](const auto& of) { return none_precedes(of.second); }) &&
         (early_.empty() || !precedes(early_.begin()->first, launch));
}

bool DispatchLoop::take(Processor& processor) {
  const std::lock_guard lock(mutex_);
  if (is_over() || !may_take()) return false;
  if (target_ && processor.in_flight() > 0 && paths_left() <= 0) return false;
  auto launch = schedule_.next([&](std::int64_t left, int samples) {
    if (target_) left = std::clamp<std::int64_t>(paths_left() / samples, 1, left);
    return processor.pace().wanted_jobs(left, samples);
  });
  if (!launch) return false;
  started_paths_ += static_cast<std::uint64_t>(launch->jobs * launch->block_samples);
  in_flight_[&processor].push_back(*launch);
  launch->first_sample += settings_.first_sample;
  processor.enqueue(*launch);
  return true;
}

// A launch that is missing may be the one that the early results wait for.
bool DispatchLoop::may_take() const {
  return !schedule_.missing().empty() || (schedule_.has_more() && early_.size() < most_early_);
}

bool DispatchLoop::all_idle() const {
  return std::ranges::all_of(in_flight_, [](const auto& of) { return of.second.empty(); });
}

// When nothing can be started: whether something can be later, as results were added to the film or a
// processor that failed has given launches back.
bool DispatchLoop::wait_for_more() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return is_over() || may_take() || all_idle(); });
  return !is_over() && may_take();
}

bool DispatchLoop::is_finished() {
  const std::lock_guard lock(mutex_);
  return is_over() || (all_idle() && !schedule_.has_more());
}

// Whether the processor is to try again.
bool DispatchLoop::recover(Processor& processor, const Failure& failure, int failures) {
  constexpr int most_tries = 10; // with smaller and smaller launches
  processor.abandon();
  const bool smaller = failure.memory_is_short && processor.shrink();
  const bool again = !failure.for_good && (failures == 1 || (smaller && failures < most_tries));
  const std::string what = fmt::format("{}: {}", processor.name(), failure.text);
  {
    const std::lock_guard lock(mutex_);
    give_back(processor);
    if (!again)
      give_up(what);
    else if (events_.warning && failures == 1)
      events_.warning(fmt::format("{}: its work is repeated after a pause{}", what,
                                  smaller ? ", with fewer work-items" : ""));
  }
  changed_.notify_all();
  if (again && failures == 1) pause(settings_);
  return again;
}

void DispatchLoop::give_up(const std::string& what) {
  ++given_up_;
  last_failure_ = what;
  if (events_.warning) events_.warning(fmt::format("{}: the device is given up", what));
}

void DispatchLoop::give_back(const Processor& processor) {
  std::deque<Launch>& launches = in_flight_[&processor];
  for (const Launch& launch : launches)
    started_paths_ -= static_cast<std::uint64_t>(launch.jobs * launch.block_samples);
  schedule_.give_back(launches);
  launches.clear();
}

// Ends the render on every processor.
void DispatchLoop::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

RenderState DispatchLoop::state() const {
  RenderState state{counts_, schedule_.position(), seconds()};
  std::vector<Launch>& missing = state.position.missing;
  for (const auto& [processor, launches] : in_flight_)
    missing.insert(missing.end(), launches.begin(), launches.end());
  for (const auto& [launch, result] : early_) missing.push_back(launch);
  std::ranges::sort(missing, precedes);
  return state;
}

bool DispatchLoop::report() const {
  if (!events_.progress) return true;
  Progress progress;
  progress.samples_done = static_cast<double>(counts_.paths) / static_cast<double>(film_.pixels().size());
  if (!open_ended_) progress.samples_total = settings_.samples_per_pixel;
  progress.seconds = seconds();
  progress.paths = counts_.paths;
  progress.state = [this] { return state(); };
  return events_.progress(progress);
}

bool DispatchLoop::is_over() const {
  return ended_ || (settings_.time_limit && seconds() >= *settings_.time_limit);
}

// Until the requested error, as far as is known.
std::int64_t DispatchLoop::paths_left() const {
  return static_cast<std::int64_t>(std::ceil(target_->wanted_paths() - static_cast<double>(started_paths_)));
}

} // namespace phlux::render
