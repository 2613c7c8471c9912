#include "bench/common/methods/timed_render.h"

#include <algorithm>
#include <cmath>

#include <sys/resource.h>

#include "errors.h"

namespace phlux::bench {
namespace {

constexpr double longest_launch_seconds = 0.05;

// Pixels of a light-traced image have no samples of their own: there the paths per pixel of the image count.
bool all_pixels(const film::Film& film, const std::function<bool(double)>& have) {
  if (std::ranges::all_of(film.pixels(), [](const film::Pixel& pixel) { return pixel.samples == 0; }))
    return have(film.samples_per_pixel());
  return std::ranges::all_of(
      film.pixels(), [&](const film::Pixel& pixel) { return have(static_cast<double>(pixel.samples)); });
}

double processor_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

bool every_pixel_has_one(const film::Film& film) {
  return all_pixels(film, [](double samples) { return samples == 1; });
}

bool every_pixel_has_some(const film::Film& film) {
  return all_pixels(film, [](double samples) { return samples >= 1; });
}

// For a time that was too short for one sample per pixel.
TimedRender render_once(const scene::Scene& scene, render::Settings settings, std::size_t time) {
  film::Film film(scene.camera.width, scene.camera.height);
  settings.samples_per_pixel = 1;
  settings.time_limit.reset();
  TimedRender result;
  result.statistics = render::render(scene, settings, film, {});
  result.last = {estimate_of(film), result.statistics.seconds_render, time};
  result.one_sample = result.last.image;
  result.paths = static_cast<double>(result.statistics.paths);
  return result;
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

TimedRender render_for(const scene::Scene& scene, render::Settings settings, double seconds,
                       const std::vector<double>& times, const std::function<bool()>& interrupted) {
  film::Film film(scene.camera.width, scene.camera.height);
  TimedRender result;
  settings.time_limit = seconds;
  settings.launch_seconds = std::min(longest_launch_seconds, times.empty() ? seconds / 8 : times.front() / 2);
  std::size_t next = 0;
  bool stopped = false;
  std::optional<std::uint64_t> first_paths;
  double first_processor_seconds = 0;
  render::Events events;
  events.progress = [&](const render::Progress& progress) {
    if (!first_paths) { // the set-up is done
      first_paths = progress.paths;
      first_processor_seconds = processor_seconds();
    }
    if (!result.one_sample && progress.samples_done == 1.0 && every_pixel_has_one(film))
      result.one_sample = estimate_of(film);
    if (next < times.size() && progress.seconds >= times[next]) {
      while (next < times.size() && progress.seconds >= times[next]) ++next;
      if (every_pixel_has_some(film))
        result.intermediate.push_back({estimate_of(film), progress.seconds, next - 1});
    }
    stopped = interrupted && interrupted();
    return !stopped;
  };
  result.statistics = render::render(scene, settings, film, events);
  if (stopped) throw Interrupted{};
  if (!every_pixel_has_some(film)) return render_once(scene, settings, times.size());
  result.last = {estimate_of(film), result.statistics.seconds_render, times.size()};
  result.paths = static_cast<double>(result.statistics.paths);
  if (const double paths = result.paths - static_cast<double>(first_paths.value_or(0)); paths > 0)
    result.processor_seconds_per_sample = (processor_seconds() - first_processor_seconds) / paths;
  return result;
}

film::Film render_samples(const scene::Scene& scene, const render::Settings& settings,
                          const std::function<bool()>& interrupted) {
  film::Film film(scene.camera.width, scene.camera.height);
  bool stopped = false;
  render::Events events;
  events.progress = [&](const render::Progress&) { return !(stopped = interrupted && interrupted()); };
  (void)render::render(scene, settings, film, events);
  if (stopped) throw Interrupted{};
  return film;
}

ImageEstimate render_one_sample(const scene::Scene& scene, const render::Settings& settings) {
  return render_once(scene, settings, 0).last.image;
}

} // namespace phlux::bench
