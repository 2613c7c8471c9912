#include "advice/advice.h"

#include <cmath>

#include <fmt/format.h>

#include "advice/light_shares.h"
#include "errors.h"
#include "render/names.h"
#include "render/quiet_log.h"
#include "scene/image_size.h"

namespace phlux::advice {
namespace {

constexpr int longest_side = 64; // pixels of a trial's image
constexpr double worth_saying = 2.0;
constexpr double most_of_it = 0.8; // of the variance

struct Method {
  const char* options;
  const char* integrator;
};
constexpr Method methods[] = {{"-i path", "path"}, {"-i bidir", "bidir"}, {"-i light", "light"}};

std::string own_options(const render::Settings& s) {
  std::string text = "-i " + s.integrator;
  if (s.integrator == "path") text += " --connect " + render::name_of(s.connect);
  if (s.integrator == "bidir") text += " --weights " + render::name_of(s.weights);
  if (s.light_selection != render::Settings().light_selection)
    text += " --light-selection " + render::name_of(s.light_selection);
  if (s.connections != render::Settings().connections)
    text += fmt::format(" --connections {}", s.connections);
  return text;
}

bool is_default(const render::Settings& settings, const Method& method) {
  return settings.integrator == method.integrator && settings.connect == render::Settings().connect &&
         settings.weights == render::Settings().weights &&
         settings.light_selection == render::Settings().light_selection &&
         settings.connections == render::Settings().connections;
}

Trial try_method(const scene::Scene& scene, const render::Settings& settings,
                 const std::string& options) try {
  film::Film film(scene.camera.width, scene.camera.height);
  const render::Statistics statistics = render::render(scene, settings, film, {});
  const auto samples = static_cast<double>(film.samples());
  const film::Reliability reliability = film::reliability_of(film);
  return {.options = options,
          .refusal = {},
          .cost = reliability.variance * statistics.seconds_render / samples,
          .reliability = reliability};
} catch (const UsageError& error) {
  return {.options = options, .refusal = error.what(), .cost = 0.0, .reliability = {}};
}

// To one digit: trials of seconds say no more.
double rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  return std::round(x / unit) * unit;
}

std::string words_for(const std::vector<Trial>& trials, double seconds) {
  const Trial &own = trials.front(), *best = nullptr;
  for (const Trial& trial : trials)
    if (&trial != &own && trial.refusal.empty() && trial.reliability.trusted && trial.cost > 0.0)
      if (best == nullptr || trial.cost < best->cost) best = &trial;
  if (best == nullptr) return fmt::format("no other method is to be trusted after {:.2g} s either", seconds);
  const double times = own.cost / best->cost;
  if (own.cost > 0.0 && times < worth_saying) return {};
  // What is rare may not have been met in so short a time, and counts for nothing then.
  if (!(own.cost > 0.0))
    return fmt::format("try {}: in {:.2g} s this method finds no light, and that one does", best->options,
                       seconds);
  return fmt::format("try {}: at least {:g} times as efficient in {:.2g} s", best->options, rounded(times),
                     seconds);
}

// Which light it is about.
std::string words_for(const std::vector<LightShare>& shares) {
  for (const LightShare& light : shares)
    if (light.share > most_of_it)
      return fmt::format("; {:.0f}% of the variance is of {}", 100.0 * light.share, light.light);
  return {};
}

} // namespace

std::size_t trials_of(const scene::Scene& scene) {
  return std::size(methods) + 1 + lights_told_apart(scene);
}

Advice advise(scene::Scene scene, const render::Settings& settings, double seconds) {
  const render::QuietLog quiet;
  scene::shrink_image(scene.camera, longest_side);
  render::Settings trial = settings;
  trial.time_limit = seconds;
  trial.target_error.reset();
  trial.clamp.reset();
  trial.techniques = false;
  const render::Settings own = trial;
  Advice advice;
  advice.trials.push_back(try_method(scene, trial, own_options(settings)));
  trial.connect = render::Settings().connect;
  trial.weights = render::Settings().weights;
  trial.light_selection = render::Settings().light_selection;
  trial.connections = render::Settings().connections;
  trial.ambient.reset();
  for (const Method& method : methods) {
    if (is_default(settings, method)) continue;
    trial.integrator = method.integrator;
    advice.trials.push_back(try_method(scene, trial, method.options));
  }
  advice.words = words_for(advice.trials, seconds);
  if (!advice.words.empty()) advice.words += words_for(light_shares(scene, own));
  return advice;
}

} // namespace phlux::advice
