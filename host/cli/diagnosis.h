// The report at the end of a render: reliability of its error estimate, and advice.
#pragma once

#include <string>

#include "film/reliability.h"
#include "render/render.h"

namespace phlux::cli {

struct Diagnosis {
  film::Reliability reliability;
  std::string advice; ///< empty where there is none
};

/// Estimates the reliability of the film's error, and tries other methods where it is unreliable: for a
/// second each if `insist`, else only where the trials and the setup together take at most 3% of the render's
/// time.
[[nodiscard]] Diagnosis diagnose(const film::Film& film, const render::Statistics& statistics,
                                 const render::Settings& settings, scene::Scene&& scene, bool insist);

/// Logs contributions that were not finite or clamped, why the error estimate is unreliable, and the advice.
void report(const Diagnosis& diagnosis, const film::Film& film, const render::Statistics& statistics,
            const render::Settings& settings);

} // namespace phlux::cli
