// What a render says of itself at its end.
#pragma once

#include <string>

#include "film/reliability.h"
#include "render/render.h"

namespace phlux::cli {

struct Diagnosis {
  film::Reliability reliability;
  std::string advice; ///< empty where there is none
};

/// Looks at the film, and where its error cannot be trusted tries other methods: for a second each where
/// `insist`, else only where that and what came before, such as building kernels, fit 3% of the render's
/// time. The scene is not needed any more.
[[nodiscard]] Diagnosis diagnose(const film::Film& film, const render::Statistics& statistics,
                                 const render::Settings& settings, scene::Scene&& scene, bool insist);

/// In the log: what was not finite, what was clamped, why the error cannot be trusted, and what to try.
void report(const Diagnosis& diagnosis, const film::Film& film, const render::Statistics& statistics,
            const render::Settings& settings);

} // namespace phlux::cli
