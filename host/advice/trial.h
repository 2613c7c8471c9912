// Short renders of a small image, by which methods are compared.
#pragma once

#include <string>

#include "film/reliability.h"
#include "render/render.h"

namespace phlux::advice {

/// Largest share of a render's time that its trials take.
inline constexpr double share_for_trials = 0.03;
/// Longer side of a trial's image, in pixels.
inline constexpr int trial_side = 64;

struct Trial {
  std::string method;  ///< the settings that choose it, such as "`integrator` bidir"
  std::string refusal; ///< why it cannot render the scene; the rest is empty then
  /// Squared relative standard error x what the trial took: that of the reliability x seconds, or as
  /// choose_method() estimates both.
  double cost = 0.0;
  double relative_standard_error = 0.0; ///< Film::relative_standard_error()
  film::Reliability reliability;
  render::Statistics statistics;
};

/// The settings that choose a method and differ from their defaults.
[[nodiscard]] std::string method_of(const render::Settings& settings);

/// Renders the scene as the settings say; cost is in seconds. @throws DeviceError
[[nodiscard]] Trial try_method(const scene::Scene& scene, const render::Settings& settings,
                               const render::Events& events = {});

/// Whether the cost is known well enough for a comparison.
[[nodiscard]] bool is_comparable(const Trial& trial);

/// The settings for trials of a render: without clamping, limits of time and error, and techniques.
[[nodiscard]] render::Settings trial_settings(render::Settings settings);

} // namespace phlux::advice
