// Short renders of a small image, by which methods are compared.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "film/reliability.h"
#include "render/render.h"

namespace phlux::advice {

/// Largest share of a render's time that its trials take.
inline constexpr double share_for_trials = 0.03;
/// Longer side of a trial's image, in pixels.
inline constexpr int trial_side = 64;

/// A tile of the film (film::TileMeans).
struct TileEstimate {
  double radiance = 0.0; ///< sum over pixels and channels
  double variance = 0.0; ///< of that sum, at most
  double pixels = 0.0;
};

/// Predicted coverage down to which the corrected error is 0.7 to 1.6 times the right one in 90% of the
/// renders of tests/images/coverage_table.cpp; far below, it is a lower bound.
inline constexpr double comparable_coverage = 0.5;

struct Trial {
  std::string method;  ///< the settings that choose it, such as "`integrator` bidir"
  std::string refusal; ///< why it cannot render the scene; the rest is empty then
  /// Squared relative standard error x what the trial took: that of the reliability x seconds, or as
  /// choose_method() estimates both.
  double cost = 0.0;
  double relative_standard_error = 0.0; ///< Film::relative_standard_error()
  film::Reliability reliability;
  std::vector<TileEstimate> tiles; ///< the same tiles in all trials of a scene
  render::Statistics statistics;
};

/// The settings that choose a method and differ from their defaults.
[[nodiscard]] std::string method_of(const render::Settings& settings);

/// Renders the scene as the settings say; cost is in seconds. `known`: of earlier trials of the scene.
/// @throws DeviceError
[[nodiscard]] Trial try_method(const scene::Scene& scene, const render::Settings& settings,
                               tables::KnownGeometry& known, const render::Events& events = {});

/// Whether the cost is known well enough for a comparison.
[[nodiscard]] bool is_comparable(const Trial& trial);

/// The relative standard error of a pixel, as root mean square, by light that the trial lacks and others
/// found: without rare, bright samples the mean of a tile is too small, and so is its variance. Where the
/// mean is more than four standard errors below that of another trial, the difference is taken as the tile's
/// standard error. Of light that a trial finds with probability p < 1 the standard error is about p^(-1/2)
/// times that light: this is a lower bound.
[[nodiscard]] double missing_error(const Trial& trial, std::span<const Trial> others);

/// The settings for trials of a render: without clamping, limits of time and error, and techniques.
[[nodiscard]] render::Settings trial_settings(render::Settings settings);

} // namespace phlux::advice
