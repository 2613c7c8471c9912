// What else to try where a render's error cannot be trusted: by trying it.
#pragma once

#include <string>
#include <vector>

#include "film/reliability.h"
#include "render/render.h"

namespace phlux::advice {

/// One method on a small image of the scene.
struct Trial {
  std::string method;  ///< the settings that choose it, such as "`integrator` bidir"
  std::string refusal; ///< why it cannot render the scene; the rest is empty then
  double cost = 0.0;   ///< relative variance of one sample x seconds of one
  film::Reliability reliability;
};

struct Advice {
  std::vector<Trial> trials; ///< the render's own method first
  std::string words;         ///< empty where there is nothing to say
};

/// How many renders advise() makes at most.
[[nodiscard]] std::size_t trials_of(const scene::Scene& scene);

/// Renders small images of the scene by the settings' method and by the others, each for `seconds` once its
/// kernels are built, and says which of those that can be trusted is more than twice as efficient and, where
/// one light makes the most of the variance, which. @throws DeviceError
[[nodiscard]] Advice advise(scene::Scene scene, const render::Settings& settings, double seconds);

} // namespace phlux::advice
