#include "settings/choices.h"

#include <algorithm>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::settings {
namespace {

void check_conditions(const Choices& choices, const Settings& settings) {
  for (const Setting& setting : all())
    if (choices.has(setting.name))
      for (const Setting::Condition& condition : setting.conditions)
        if (!condition.holds(settings))
          throw UsageError(quoted(setting.name) +
                           fmt::format(fmt::runtime(condition.otherwise), settings.integrator));
}

} // namespace

void Choices::choose(const Setting& setting, const std::string& text) {
  Settings valid;
  setting.read(text, valid);
  texts.insert_or_assign(setting.name, text);
}

bool Choices::has_amount() const {
  return std::ranges::any_of(
      all(), [&](const Setting& setting) { return setting.affects == Affects::amount && has(setting.name); });
}

void Choices::complete(const Choices& earlier) {
  definitions.insert(earlier.definitions.begin(), earlier.definitions.end());
  if (!size) size = earlier.size;
  const auto integrator = texts.find("integrator");
  if (!earlier.auto_reasons.empty() && (integrator == texts.end() || integrator->second == "auto")) {
    texts.erase("integrator");
    auto_reasons = earlier.auto_reasons;
  }
  const bool amount = has_amount();
  const auto precision = texts.find("precision");
  const bool in_double = precision != texts.end() && precision->second == "double"; // excludes a width
  for (const Setting& setting : all()) {
    const auto then = earlier.texts.find(setting.name);
    if (then == earlier.texts.end() || (amount && setting.affects == Affects::amount) ||
        (in_double && setting.name == "width") || setting.name == "threads") // another machine has others
      continue;
    texts.insert(*then);
  }
}

Settings settings_of(const Choices& choices, const scene::RenderDefaults& scene, Settings settings) {
  for (const Setting& setting : all())
    if (setting.from_scene) setting.from_scene(scene, settings);
  for (const auto& [name, text] : choices.texts) named(name).read(text, settings);
  check_conditions(choices, settings);
  if (settings.techniques && !integrator_named(settings.integrator).light_paths)
    throw UsageError("`contributions`: path tracing has only one technique: use `integrator` bidir or light");
  return settings;
}

} // namespace phlux::settings
