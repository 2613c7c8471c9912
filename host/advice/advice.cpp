#include "advice/advice.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "advice/automatic.h"
#include "advice/light_shares.h"
#include "scene/image_size.h"

namespace phlux::advice {
namespace {

constexpr double least_gain = 2.0;     // in efficiency, for a suggestion
constexpr double dominant_share = 0.8; // of the variance
// The right error of a comparable trial is up to 1.6 times its estimate (trial.cpp).
constexpr double largest_correction = 1.6 * 1.6; // of a cost

// One significant digit: short trials are no more accurate.
double rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  return std::round(x / unit) * unit;
}

// The light that dominates the variance, if any.
std::string words_for(const std::vector<LightShare>& shares) {
  for (const LightShare& light : shares)
    if (light.share > dominant_share)
      return fmt::format("; {:.0f}% of the variance comes from {}", 100.0 * light.share, light.light);
  return {};
}

// What the method misses; see misses_light().
std::string missed_light(const scene::Scene& scene, const std::string& integrator) {
  if (!misses_light(scene, settings::integrator_named(integrator))) return {};
  return integrator == "light"
             ? "light misses what the camera sees in mirrors and through smooth glass"
             : "path misses the light that point, spot and directional emitters send through mirrors and "
               "smooth glass";
}

} // namespace

std::size_t trials_of(const scene::Scene& scene) {
  return settings::integrators.size() + 1 + light_share_renders(scene);
}

void conclude(Advice& advice, double seconds) {
  const Trial &own = advice.trials.front(), *best = nullptr;
  for (const Trial& trial : advice.trials)
    if (&trial != &own && is_comparable(trial) && (best == nullptr || trial.cost < best->cost)) best = &trial;
  const bool finds_light = own.cost > 0.0;
  const double times = best != nullptr ? own.cost / best->cost : 0.0;
  advice.found = best != nullptr && (times >= least_gain || !finds_light);
  if (advice.found && !finds_light)
    advice.words =
        fmt::format("try {}: in a trial of {:.2g} s it found light, and this integrator found none",
                    best->method, seconds);
  else if (advice.found)
    advice.words = fmt::format("try {}: {} {:g} times as efficient in a trial of {:.2g} s", best->method,
                               is_comparable(own) ? "about" : "at least", rounded(times), seconds);
  else if (own.reliability.trusted ||
           (best != nullptr && is_comparable(own) && times * largest_correction < least_gain))
    advice.words = fmt::format("no better integrator was found in trials of {:.2g} s", seconds);
  else
    advice.words =
        fmt::format("trials of {:.2g} s are too noisy to tell which integrator is better", seconds);
}

Advice advise(scene::Scene scene, const render::Settings& settings, double seconds,
              const film::Progress& progress) {
  const std::size_t trials = trials_of(scene);
  Advice advice;
  render::Events events;
  if (progress)
    events.progress = [&](const render::Progress&) {
      progress(static_cast<double>(advice.trials.size()) / static_cast<double>(trials));
      return true;
    };
  scene::shrink_image(scene.camera, trial_side);
  render::Settings trial = trial_settings(settings);
  trial.time_limit = seconds;
  const render::Settings own = trial;
  tables::KnownGeometry known;
  advice.trials.push_back(try_method(scene, own, known, events));
  for (const settings::Setting& setting : settings::all())
    if (!setting.conditions.empty()) setting.copy({}, trial);
  for (const settings::IntegratorInfo& info : settings::integrators) {
    trial.integrator = info.name;
    if (method_of(trial) != method_of(own) && !misses_light(scene, info))
      advice.trials.push_back(try_method(scene, trial, known, events));
  }
  for (Trial& one : advice.trials) {
    const double missing = missing_error(one, advice.trials);
    one.cost += missing * missing * one.statistics.seconds_render;
  }
  conclude(advice, seconds);
  if (const std::string missed = missed_light(scene, settings.integrator); !missed.empty()) {
    advice.found = true;
    advice.words = fmt::format("try `integrator` bidir: {}", missed);
  } else if (finds_caustics_by_chance(scene, settings.integrator))
    advice.words += "; path finds caustics, the light of area emitters through mirrors and smooth glass, by "
                    "chance only: bidir finds them";
  if (!advice.trials.front().reliability.trusted) advice.words += words_for(light_shares(scene, own, events));
  return advice;
}

} // namespace phlux::advice
