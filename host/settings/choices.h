// The settings that the user has chosen for a render; the scene and the defaults determine the others.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "settings/settings.h"

namespace phlux::settings {

struct Choices {
  std::map<std::string, std::string> definitions; ///< values of the scene's $names
  std::optional<std::array<int, 2>> size;         ///< width, height
  std::map<std::string, std::string> texts;       ///< of the chosen settings, by name
  std::string auto_reasons; ///< why `integrator auto` has chosen some of the texts; empty: it was not auto

  /// @throws UsageError "`NAME` TEXT: what would be right"
  void choose(const Setting& setting, const std::string& text);
  [[nodiscard]] bool has(const std::string& name) const { return texts.contains(name); }
  /// Whether a setting with Affects::amount is chosen.
  [[nodiscard]] bool has_amount() const;

  /// Adds choices of `earlier` that are absent here; settings with Affects::amount only if none is chosen
  /// here. `integrator auto` stays what it was then.
  void complete(const Choices& earlier);
};

/// `defaults`, overridden by the scene's settings, which the choices override.
/// @throws UsageError for choices that exclude each other
[[nodiscard]] Settings settings_of(const Choices& choices, const scene::RenderDefaults& scene,
                                   Settings defaults = {});

} // namespace phlux::settings
