// The choice of a method for `integrator` auto.
#pragma once

#include <map>
#include <string>

#include "advice/trial.h"
#include "settings/choices.h"

namespace phlux::advice {

/// Whether the integrator finds caustics of area emitters only by hits of these after delta events, so rarely
/// that short trials lack them.
[[nodiscard]] bool finds_caustics_by_chance(const scene::Scene& scene, const std::string& integrator);

struct MethodChoice {
  std::map<std::string, std::string> texts; ///< the settings of the method, by name
  std::string words;                        ///< the method and why, in one line
};

/// Whether the integrator cannot find some of the scene's light, which its error estimate then does not
/// include: `path` cannot find light of point, spot and directional emitters after a delta event, `light`
/// cannot find light that a delta event scatters to the camera.
[[nodiscard]] bool misses_light(const scene::Scene& scene, const settings::IntegratorInfo& integrator);

/// Chooses among path, light and bidir, and then among the variants of the best: the least variance x time in
/// trial renders. The variance is relative to the squared mean of each pixel, as that of `bench scenes`,
/// corrected for rare light that the trial lacks. path and bidir sample by lattices if there are at least 128
/// samples per pixel, and their costs then include what lattices save on average. The trials take about 3% of
/// the render's time; a render that is too short for them is by the scene's integrator. Costs are computed
/// from the numbers of rays, not measured, so that a seed always leads to the same method. `choices` may fix
/// other settings; `integrator` among them is ignored.
/// @throws UsageError if the choices exclude every integrator, DeviceError
[[nodiscard]] MethodChoice choose_method(scene::Scene scene, const settings::Choices& choices,
                                         const render::Settings& defaults);

} // namespace phlux::advice
