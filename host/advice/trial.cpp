#include "advice/trial.h"

#include <fmt/format.h>

#include "errors.h"

namespace phlux::advice {
namespace {

// Predicted coverage down to which the corrected error is 0.7 to 1.6 times the right one in 90% of the
// renders of tests/images/coverage_table.cpp; far below, it is a lower bound.
constexpr double comparable_coverage = 0.5;

} // namespace

std::string method_of(const render::Settings& of) {
  std::string text = "`integrator` " + of.integrator;
  for (const settings::Setting& setting : settings::all())
    if (!setting.conditions.empty() && setting.value(of) != setting.value({}))
      text += fmt::format(" {} {}", settings::quoted(setting.name), setting.text(of));
  return text;
}

Trial try_method(const scene::Scene& scene, const render::Settings& settings, const render::Events& events) {
  Trial trial;
  trial.method = method_of(settings);
  try {
    film::Film film(scene.camera.width, scene.camera.height);
    trial.statistics = render::render(scene, settings, film, events);
    trial.relative_standard_error = film.relative_standard_error();
    trial.reliability = film::reliability_of(film);
    const double error = trial.reliability.relative_standard_error;
    trial.cost = error * error * trial.statistics.seconds_render;
  } catch (const UsageError& error) {
    trial.refusal = error.what();
  }
  return trial;
}

bool is_comparable(const Trial& trial) {
  return trial.cost > 0.0 && trial.reliability.coverage >= comparable_coverage &&
         trial.reliability.variance_error <= film::largest_variance_error;
}

render::Settings trial_settings(render::Settings settings) {
  settings.time_limit.reset();
  settings.target_error.reset();
  settings.clamp.reset();
  settings.techniques = false;
  return settings;
}

} // namespace phlux::advice
