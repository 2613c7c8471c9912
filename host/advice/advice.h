// Compares the method of a render with others in short trial renders.
#pragma once

#include <string>
#include <vector>

#include "advice/trial.h"

namespace phlux::advice {

struct Advice {
  std::vector<Trial> trials; ///< the render's own method first
  bool found = false;        ///< whether another method is better
  std::string words;         ///< the answer: that method, or why there is none; never empty
};

/// Sets `found` and `words` from the trials, which took `seconds` each.
void conclude(Advice& advice, double seconds);

/// The largest number of renders that advise() makes.
[[nodiscard]] std::size_t trials_of(const scene::Scene& scene);

/// Renders small images of the scene by the settings' method and by the others, each for `seconds` after its
/// kernels are built. Suggests the most efficient method if it is at least twice as efficient. Costs are
/// corrected for rare light that pixels lack, and methods that lack too much of it are not suggested. If the
/// error estimate of the method is unreliable, names the light that causes most of the variance, if any.
/// `progress`: of the trials; what it throws ends them. @throws DeviceError
[[nodiscard]] Advice advise(scene::Scene scene, const render::Settings& settings, double seconds,
                            const film::Progress& progress = {});

} // namespace phlux::advice
