#include "cli/diagnosis.h"

#include <algorithm>

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "advice/advice.h"
#include "cli/spelling.h"
#include "errors.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

constexpr double longest_trial = 1.0, shortest_trial = 0.2;

// Seconds per trial; 0: no trials.
double trial_seconds(const render::Statistics& statistics, std::size_t trials, bool insist) {
  if (insist) return longest_trial;
  const double before = statistics.seconds_setup + statistics.seconds_build_kernels;
  const double seconds =
      advice::share_for_trials * statistics.seconds_render / static_cast<double>(trials) - before;
  return seconds < shortest_trial ? 0.0 : std::min(seconds, longest_trial);
}

std::string remedies(const Diagnosis& diagnosis, const render::Settings& settings) {
  if (diagnosis.better_found) return diagnosis.advice;
  const char* clamp = settings.clamp || settings.techniques ? "" : ", or limit bright paths with --clamp";
  if (diagnosis.advice.empty())
    return fmt::format("take more samples, let --advise try other integrators{}", clamp);
  return fmt::format("{}: take more samples{}", diagnosis.advice, clamp);
}

// The error that the render states, the error that it may have, and why.
std::string doubt(const film::Reliability& r, double stated, const film::Film& film,
                  const render::Settings& settings) {
  if (!(r.variance > 0.0)) return fmt::format("the error is unknown: {}", r.reasons.front());
  std::string text =
      fmt::format("the relative standard error of {:.3g}% may be {:.3g}% ({}", 100.0 * stated,
                  100.0 * std::max(stated, r.relative_standard_error), fmt::join(r.reasons, "; "));
  if (r.worst_share > 0.5 && film.evidence().tiles().count() > 2) {
    const auto [x, y] = place_of(std::int64_t{r.worst_y} * film.width() + r.worst_x, film, settings);
    text += fmt::format("; most of the variance is near pixel ({}, {})", x, y);
  }
  return text + ")";
}

} // namespace

void estimate_error(const film::Film& film, LastSteps& steps, Patience& patience, Diagnosis& diagnosis) {
  diagnosis.error = film.relative_error(steps.optional("computing the error", patience));
  diagnosis.reliability =
      film::reliability_of(film, steps.optional("computing the reliability of the error", patience));
}

void try_other_methods(const render::Statistics& statistics, const render::Settings& settings,
                       scene::Scene&& scene, bool insist, LastSteps& steps, Patience& patience,
                       Diagnosis& diagnosis) {
  if (statistics.interrupted || !statistics.shines || !diagnosis.reliability ||
      (diagnosis.reliability->trusted && !insist))
    return;
  const double seconds = trial_seconds(statistics, advice::trials_of(scene), insist);
  if (!(seconds > 0.0)) return;
  try {
    const advice::Advice advice = advice::advise(std::move(scene), settings, seconds,
                                                 steps.optional("trying other integrators", patience));
    diagnosis.advice = with_options(advice.words);
    diagnosis.better_found = advice.found;
  } catch (const DeviceError& error) {
    if (insist) throw;
    spdlog::info("no trials of other integrators: {}", error.what());
  }
}

void report(const Diagnosis& diagnosis, const film::Film& film, const render::Statistics& statistics,
            const render::Settings& settings, double clamped_share, bool quiet) {
  if (const auto& origin = statistics.first_nonfinite) {
    const auto [x, y] = place_of(origin->pixel, film, settings);
    spdlog::warn(
        "{} contributions were not finite and count as black: the first is of pixel ({}, {}), sample {}{}, "
        "seed {}",
        statistics.nonfinite, x, y, origin->sample,
        origin->samples > 1 ? fmt::format(" to {}", origin->sample + origin->samples - 1) : "",
        settings.seed);
  }
  if (settings.clamp)
    spdlog::warn("--clamp {:g}: the image is biased: {:.3g}% of its light was removed", *settings.clamp,
                 100.0 * clamped_share);
  if (quiet || !diagnosis.reliability) return;
  const film::Reliability& r = *diagnosis.reliability;
  if (statistics.shines && !r.trusted && !r.reasons.empty() &&
      film.samples_per_pixel() >= film::least_samples)
    spdlog::warn("{}: {}", doubt(r, diagnosis.error.standard_error, film, settings),
                 remedies(diagnosis, settings));
  else if (!diagnosis.advice.empty())
    say("advice: {}\n", diagnosis.advice);
}

} // namespace phlux::cli
