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
  /// Marginal: the time after the first launch for the paths after it, so that the fixed costs of a short
  /// render are not charged to its samples. Of a render of one launch: the whole time.
  double seconds_per_sample = 0;
  double processor_seconds_per_sample = 0; ///< the same in processor time of this process, over all threads
  render::Statistics statistics;

  [[nodiscard]] double samples_per_pixel() const {
    return paths / static_cast<double>(last.image.samples.size());
  }
};

struct CountedRender {
  film::Film film;
  render::Statistics statistics;
  double processor_seconds = 0; ///< of this process, over all threads

  [[nodiscard]] double rays_per_sample() const {
    return static_cast<double>(statistics.rays + statistics.shadow_rays) /
           static_cast<double>(statistics.paths);
  }
};

/// Renders one scene by one method several times; its program and tables stay on the devices.
class MethodRenderer {
public:
  /// @throws as Renderer
  MethodRenderer(const scene::Scene& scene, const render::Settings& settings);

  /// Renders for `seconds`, or one sample per pixel if that takes longer, and keeps the image after each of
  /// `times` (ascending, less than `seconds`). Calls `interrupted` between launches. @throws Interrupted, and
  /// as render()
  [[nodiscard]] TimedRender render_for(std::uint64_t seed, double seconds, const std::vector<double>& times,
                                       const std::function<bool()>& interrupted);

  /// Renders one sample per pixel. @throws as render()
  [[nodiscard]] TimedRender render_one_sample(std::uint64_t seed);

  /// Renders `samples` per pixel. @throws Interrupted, and as render()
  [[nodiscard]] CountedRender render_samples(std::uint64_t seed, int samples,
                                             const std::function<bool()>& interrupted);

private:
  int width_, height_;
  render::Settings settings_;
  render::Renderer renderer_;
};

} // namespace phlux::bench
