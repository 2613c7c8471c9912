// The report at the end of a render: reliability of its error estimate, and advice.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/last_steps.h"
#include "film/reliability.h"
#include "render/render.h"

namespace phlux::cli {

struct Diagnosis {
  film::Film::RelativeError error;              ///< infinite until it is computed
  std::optional<film::Reliability> reliability; ///< nothing until it is computed
  std::string advice;                           ///< empty without trials
  bool better_found = false;                    ///< whether the advice is another integrator
};

/// Estimates the film's error and its reliability. @throws StepInterrupted; what is computed then is kept
void estimate_error(const film::Film& film, LastSteps& steps, Patience& patience, Diagnosis& diagnosis);

/// Tries other methods: for a second each if `insist`, else only if the error is unreliable and the trials
/// and the setup together take at most 3% of the render's time. None without the reliability, or if the
/// render was interrupted. @throws DeviceError of a trial if `insist`, StepInterrupted
void try_other_methods(const render::Statistics& statistics, const render::Settings& settings,
                       scene::Scene&& scene, bool insist, LastSteps& steps, Patience& patience,
                       Diagnosis& diagnosis);

/// Column and row in the whole image of a pixel of the film, which may be a part of it.
[[nodiscard]] inline std::array<int, 2> place_of(std::int64_t pixel, const film::Film& film,
                                                 const render::Settings& settings) {
  const scene::Window crop = settings.crop.value_or(scene::Window());
  return {crop.x + static_cast<int>(pixel % film.width()), crop.y + static_cast<int>(pixel / film.width())};
}

/// Logs contributions that were not finite or clamped; `clamped_share` is the film's. Unless `quiet`, also
/// logs the likely error and the remedy where the error estimate is unreliable, and else prints the advice.
void report(const Diagnosis& diagnosis, const film::Film& film, const render::Statistics& statistics,
            const render::Settings& settings, double clamped_share, bool quiet);

} // namespace phlux::cli
