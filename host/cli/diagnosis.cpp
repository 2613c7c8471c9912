#include "cli/diagnosis.h"

#include <algorithm>

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "advice/advice.h"
#include "cli/spelling.h"

namespace phlux::cli {
namespace {

constexpr double share_for_trials = 0.03;   // of the render's time
constexpr double grossly_understated = 0.3; // share of the standard error that is likely to be missing
constexpr double longest_trial = 1.0, shortest_trial = 0.2;

// Seconds per trial; 0: no trials.
double trial_seconds(const render::Statistics& statistics, std::size_t trials, bool insist) {
  if (insist) return longest_trial;
  const double before = statistics.seconds_setup + statistics.seconds_build_kernels;
  const double seconds = share_for_trials * statistics.seconds_render / static_cast<double>(trials) - before;
  return seconds < shortest_trial ? 0.0 : std::min(seconds, longest_trial);
}

// Whether the error estimate is unreliable; that of a scene without light is exact.
bool doubtful(const film::Reliability& reliability, const render::Statistics& statistics) {
  return !reliability.trusted && statistics.shines;
}

} // namespace

Diagnosis diagnose(const film::Film& film, const render::Statistics& statistics,
                   const render::Settings& settings, scene::Scene&& scene, bool insist) {
  Diagnosis diagnosis{.reliability = film::reliability_of(film), .advice = {}};
  if (!doubtful(diagnosis.reliability, statistics) || statistics.interrupted) return diagnosis;
  if (const double seconds = trial_seconds(statistics, advice::trials_of(scene), insist); seconds > 0.0)
    diagnosis.advice = with_options(advice::advise(std::move(scene), settings, seconds).words);
  return diagnosis;
}

void report(const Diagnosis& diagnosis, const film::Film& film, const render::Statistics& statistics,
            const render::Settings& settings) {
  if (const auto& origin = statistics.first_nonfinite)
    spdlog::warn(
        "{} contributions were not finite and count as black: the first is of pixel ({}, {}), sample {}{}, "
        "seed {}",
        statistics.nonfinite, origin->pixel % film.width(), origin->pixel / film.width(), origin->sample,
        origin->samples > 1 ? fmt::format(" to {}", origin->sample + origin->samples - 1) : "",
        settings.seed);
  if (settings.clamp)
    spdlog::warn("--clamp {:g}: the image is biased: {:.3g}% of its light was taken away", *settings.clamp,
                 100.0 * film.clamped_share());
  const film::Reliability& r = diagnosis.reliability;
  if (!doubtful(r, statistics) || film.samples_per_pixel() < film::least_samples) return;
  const bool nearly =
      r.reasons.size() == 1 && r.understated > film::most_understated && r.understated < grossly_understated;
  std::string text = fmt::format("the error estimate is not {}to be trusted: {}", nearly ? "quite " : "",
                                 fmt::join(r.reasons, "; "));
  if (r.worst_share > 0.5)
    text += fmt::format("; most of the variance is near pixel ({}, {})", r.worst_x, r.worst_y);
  spdlog::warn("{}", text);
  if (!diagnosis.advice.empty()) spdlog::warn("{}", diagnosis.advice);
}

} // namespace phlux::cli
