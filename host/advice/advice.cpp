#include "advice/advice.h"

#include <cmath>

#include <fmt/format.h>

#include "advice/light_shares.h"
#include "errors.h"
#include "scene/image_size.h"

namespace phlux::advice {
namespace {

constexpr int longest_side = 64;       // pixels of a trial's image
constexpr double least_gain = 2.0;     // in efficiency, for a suggestion
constexpr double dominant_share = 0.8; // of the variance

// The settings that choose a method and differ from their defaults.
std::string method_of(const render::Settings& of) {
  std::string text = "`integrator` " + of.integrator;
  for (const settings::Setting& setting : settings::all())
    if (!setting.conditions.empty() && setting.value(of) != setting.value({}))
      text += fmt::format(" {} {}", settings::quoted(setting.name), setting.text(of));
  return text;
}

Trial try_method(const scene::Scene& scene, const render::Settings& settings, const std::string& method) try {
  film::Film film(scene.camera.width, scene.camera.height);
  const render::Statistics statistics = render::render(scene, settings, film, {});
  const auto samples = static_cast<double>(film.samples());
  const film::Reliability reliability = film::reliability_of(film);
  return {.method = method,
          .refusal = {},
          .cost = reliability.variance * statistics.seconds_render / samples,
          .reliability = reliability};
} catch (const UsageError& error) {
  return {.method = method, .refusal = error.what(), .cost = 0.0, .reliability = {}};
}

// One significant digit: short trials are no more accurate.
double rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  return std::round(x / unit) * unit;
}

std::string words_for(const std::vector<Trial>& trials, double seconds) {
  const Trial &own = trials.front(), *best = nullptr;
  for (const Trial& trial : trials)
    if (&trial != &own && trial.refusal.empty() && trial.reliability.trusted && trial.cost > 0.0)
      if (best == nullptr || trial.cost < best->cost) best = &trial;
  if (best == nullptr)
    return fmt::format("after {:.2g} s the error estimate of no other method is to be trusted either",
                       seconds);
  const double times = own.cost / best->cost;
  if (own.cost > 0.0 && times < least_gain) return {};
  // A short trial may find no light; its cost is then 0.
  if (!(own.cost > 0.0))
    return fmt::format("try {}: in {:.2g} s this method finds no light, and that one does", best->method,
                       seconds);
  return fmt::format("try {}: at least {:g} times as efficient in {:.2g} s", best->method, rounded(times),
                     seconds);
}

// The light that dominates the variance, if any.
std::string words_for(const std::vector<LightShare>& shares) {
  for (const LightShare& light : shares)
    if (light.share > dominant_share)
      return fmt::format("; {:.0f}% of the variance comes from {}", 100.0 * light.share, light.light);
  return {};
}

} // namespace

std::size_t trials_of(const scene::Scene& scene) {
  return settings::integrators.size() + 1 + light_share_renders(scene);
}

Advice advise(scene::Scene scene, const render::Settings& settings, double seconds) {
  scene::shrink_image(scene.camera, longest_side);
  render::Settings trial = settings;
  trial.time_limit = seconds;
  trial.target_error.reset();
  trial.clamp.reset();
  trial.techniques = false;
  const render::Settings own = trial;
  Advice advice;
  advice.trials.push_back(try_method(scene, own, method_of(own)));
  for (const settings::Setting& setting : settings::all())
    if (!setting.conditions.empty()) setting.copy({}, trial);
  for (const settings::IntegratorInfo& info : settings::integrators) {
    trial.integrator = info.name;
    if (const std::string method = method_of(trial); method != method_of(own))
      advice.trials.push_back(try_method(scene, trial, method));
  }
  advice.words = words_for(advice.trials, seconds);
  if (!advice.words.empty()) advice.words += words_for(light_shares(scene, own));
  return advice;
}

} // namespace phlux::advice
