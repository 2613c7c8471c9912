// Renders for a given time, with intermediate images.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "render/render.h"

namespace phlux::bench {

/// Thrown where the user has interrupted a measurement.
struct Interrupted {};

/// Calls `work`; returns false if the user interrupted it.
[[nodiscard]] bool runs_to_end(const std::function<void()>& work, const std::function<bool()>& interrupted);

struct Snapshot {
  ImageEstimate image;
  double seconds = 0;   ///< since rendering began
  std::size_t time = 0; ///< index of the requested time; their number for the last image
};

struct TimedRender {
  std::vector<Snapshot> intermediate; ///< the first image after each requested time; missing where not every
                                      ///< pixel had a sample, or where the next time had passed too
  std::optional<ImageEstimate> one_sample; ///< the image when every pixel had exactly one sample
  Snapshot last;
  double paths = 0;
  double processor_seconds_per_sample = 0; ///< processor time of this process, over all threads
  render::Statistics statistics;

  [[nodiscard]] double seconds_per_sample() const { return last.seconds / paths; }
  [[nodiscard]] double samples_per_pixel() const {
    return paths / static_cast<double>(last.image.samples.size());
  }
};

/// Renders for `seconds`, or one sample per pixel if that takes longer, and keeps the image after each of
/// `times` (ascending, less than `seconds`). Calls `interrupted` between launches. @throws Interrupted, and
/// as render()
[[nodiscard]] TimedRender render_for(const scene::Scene& scene, render::Settings settings, double seconds,
                                     const std::vector<double>& times,
                                     const std::function<bool()>& interrupted);

/// Renders `settings.samples_per_pixel` samples without logging. @throws Interrupted, and as render()
[[nodiscard]] film::Film render_samples(const scene::Scene& scene, const render::Settings& settings,
                                        const std::function<bool()>& interrupted);

/// Renders one sample per pixel. @throws as render()
[[nodiscard]] ImageEstimate render_one_sample(const scene::Scene& scene, const render::Settings& settings);

} // namespace phlux::bench
