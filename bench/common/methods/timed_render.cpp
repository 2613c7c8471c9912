#include "bench/common/methods/timed_render.h"

#include <algorithm>
#include <cmath>

#include "bench/common/processor_time.h"
#include "errors.h"

namespace phlux::bench {
namespace {

// Duration of a launch. Each launch has a fixed cost, so only the shortest renders have shorter launches.
constexpr double launch_seconds = 0.01;
constexpr double least_launches = 5;

// Pixels of a light-traced image have no samples of their own: there the paths per pixel of the image count.
bool all_pixels(const film::Film& film, const std::function<bool(double)>& have) {
  if (std::ranges::all_of(film.pixels(), [](const film::Pixel& pixel) { return pixel.samples == 0; }))
    return have(film.samples_per_pixel());
  return std::ranges::all_of(
      film.pixels(), [&](const film::Pixel& pixel) { return have(static_cast<double>(pixel.samples)); });
}

// Time per path between the first launch and the last one. Its callbacks' processor time is excluded, as is
// the time before the results of the first launch.
class Marginal {
public:
  Marginal() : begin_processor_(processor_seconds()) {}

  void add_launch(const render::Progress& progress, double processor) {
    const Time time{static_cast<double>(progress.paths), progress.seconds, processor - excluded_};
    if (!first_) first_ = time;
    last_ = time;
  }
  void exclude(double processor) { excluded_ += processor; }

  void set(TimedRender& render) const {
    if (!first_) return;
    const bool one_launch = last_.paths == first_->paths;
    const Time begin = one_launch ? Time{0, 0, begin_processor_} : *first_;
    const double paths = last_.paths - begin.paths;
    render.seconds_per_sample = (last_.wall - begin.wall) / paths;
    render.processor_seconds_per_sample = (last_.processor - begin.processor) / paths;
  }

private:
  struct Time {
    double paths = 0, wall = 0, processor = 0;
  };
  double begin_processor_, excluded_ = 0;
  std::optional<Time> first_;
  Time last_;
};

bool every_pixel_has_one(const film::Film& film) {
  return all_pixels(film, [](double samples) { return samples == 1; });
}

bool every_pixel_has_some(const film::Film& film) {
  return all_pixels(film, [](double samples) { return samples >= 1; });
}

// Sets what follows from the statistics and the film of a complete render.
void complete(TimedRender& result, const film::Film& film, std::size_t time, const Marginal& marginal) {
  result.last = {estimate_of(film), result.statistics.seconds_render, time};
  result.paths = static_cast<double>(result.statistics.paths);
  marginal.set(result);
}

} // namespace

bool runs_to_end(const std::function<void()>& work, const std::function<bool()>& interrupted) {
  try {
    work();
  } catch (const Interrupted&) {
    return false;
  } catch (const DeviceError&) { // an interrupt also ends a running compiler
    if (interrupted && interrupted()) return false;
    throw;
  }
  return true;
}

MethodRenderer::MethodRenderer(const scene::Scene& scene, const render::Settings& settings)
    : width_(scene.camera.width), height_(scene.camera.height), settings_(settings),
      renderer_(scene, settings, {}) {}

TimedRender MethodRenderer::render_for(std::uint64_t seed, double seconds, const std::vector<double>& times,
                                       const std::function<bool()>& interrupted) {
  film::Film film(width_, height_);
  TimedRender result;
  render::Settings settings = settings_;
  settings.seed = seed;
  settings.time_limit = INFINITY; // the callback ends the render
  settings.launch_seconds = std::min(launch_seconds, seconds / least_launches);
  std::size_t next = 0;
  bool stopped = false;
  Marginal marginal;
  render::Events events;
  events.progress = [&](const render::Progress& progress) {
    const double callback_begin = processor_seconds(RUSAGE_THREAD);
    marginal.add_launch(progress, processor_seconds());
    if (!result.one_sample && progress.samples_done == 1.0 && every_pixel_has_one(film))
      result.one_sample = estimate_of(film);
    if (next < times.size() && progress.seconds >= times[next]) {
      while (next < times.size() && progress.seconds >= times[next]) ++next;
      if (every_pixel_has_some(film))
        result.intermediate.push_back({estimate_of(film), progress.seconds, next - 1});
    }
    stopped = interrupted && interrupted();
    marginal.exclude(processor_seconds(RUSAGE_THREAD) - callback_begin);
    return !stopped && progress.seconds < seconds;
  };
  result.statistics = renderer_.render(settings, film, events);
  if (stopped) throw Interrupted{};
  if (!every_pixel_has_some(film)) {
    TimedRender once = render_one_sample(seed);
    once.last.time = times.size();
    return once;
  }
  complete(result, film, times.size(), marginal);
  return result;
}

TimedRender MethodRenderer::render_one_sample(std::uint64_t seed) {
  film::Film film(width_, height_);
  render::Settings settings = settings_;
  settings.seed = seed;
  settings.samples_per_pixel = 1;
  TimedRender result;
  Marginal marginal;
  render::Events events;
  events.progress = [&](const render::Progress& progress) {
    marginal.add_launch(progress, processor_seconds());
    return true;
  };
  result.statistics = renderer_.render(settings, film, events);
  complete(result, film, 0, marginal);
  result.one_sample = result.last.image;
  return result;
}

CountedRender MethodRenderer::render_samples(std::uint64_t seed, int samples,
                                             const std::function<bool()>& interrupted) {
  CountedRender result{film::Film(width_, height_), {}};
  render::Settings settings = settings_;
  settings.seed = seed;
  settings.samples_per_pixel = samples;
  bool stopped = false;
  render::Events events;
  events.progress = [&](const render::Progress&) { return !(stopped = interrupted && interrupted()); };
  const double begin = processor_seconds();
  result.statistics = renderer_.render(settings, result.film, events);
  if (stopped) throw Interrupted{};
  result.processor_seconds = processor_seconds() - begin;
  return result;
}

} // namespace phlux::bench
