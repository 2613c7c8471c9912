// One render of a length of time, with the image as it was on the way.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "render/render.h"

namespace phlux::bench {

/// What ends a measurement that the user interrupts.
struct Interrupted {};

/// Whether `work` came to its end; false when the user interrupted it.
[[nodiscard]] bool runs_to_end(const std::function<void()>& work, const std::function<bool()>& interrupted);

struct Snapshot {
  ImageEstimate image;
  double seconds = 0;   ///< since rendering began
  std::size_t time = 0; ///< which of the times asked for it is the first after
};

struct TimedRender {
  std::vector<Snapshot> on_the_way; ///< of times by which every pixel had a sample, but those between which
                                    ///< no launch ended
  std::optional<ImageEstimate> one_sample; ///< when every pixel had one sample and none had two
  Snapshot last;
  double paths = 0;
  double processor_seconds_per_sample =
      0; ///< of this process, all threads: what other programs do is not in it
  render::Statistics statistics;

  [[nodiscard]] double seconds_per_sample() const { return last.seconds / paths; }
  [[nodiscard]] double samples_per_pixel() const {
    return paths / static_cast<double>(last.image.samples.size());
  }
};

/// Renders for `seconds`, or one sample per pixel where that takes longer, and keeps the image after each of
/// `times` (ascending, all shorter). `interrupted` is asked between launches. @throws Interrupted, and as
/// render()
[[nodiscard]] TimedRender render_for(const scene::Scene& scene, render::Settings settings, double seconds,
                                     const std::vector<double>& times,
                                     const std::function<bool()>& interrupted);

/// `settings.samples_per_pixel` samples, without the warnings that a render of the user's would give. @throws
/// Interrupted, and as render()
[[nodiscard]] film::Film render_samples(const scene::Scene& scene, const render::Settings& settings,
                                        const std::function<bool()>& interrupted);

/// An image with one sample per pixel. @throws as render()
[[nodiscard]] ImageEstimate render_one_sample(const scene::Scene& scene, const render::Settings& settings);

} // namespace phlux::bench
