// Suggests another method where a render's error estimate is unreliable, from short trial renders.
#pragma once

#include <string>
#include <vector>

#include "film/reliability.h"
#include "render/render.h"

namespace phlux::advice {

/// A render of a small image of the scene by one method.
struct Trial {
  std::string method;  ///< the settings that choose it, such as "`integrator` bidir"
  std::string refusal; ///< why it cannot render the scene; the rest is empty then
  double cost = 0.0;   ///< relative variance of a sample x seconds per sample
  film::Reliability reliability;
};

struct Advice {
  std::vector<Trial> trials; ///< the render's own method first
  std::string words;         ///< the suggestion; empty: none
};

/// The largest number of renders that advise() makes.
[[nodiscard]] std::size_t trials_of(const scene::Scene& scene);

/// Renders small images of the scene by the settings' method and by the others, each for `seconds` after its
/// kernels are built. Suggests the most efficient method with a reliable error estimate where it is at least
/// twice as efficient, and names the light that causes most of the variance, if one does.
/// @throws DeviceError
[[nodiscard]] Advice advise(scene::Scene scene, const render::Settings& settings, double seconds);

} // namespace phlux::advice
