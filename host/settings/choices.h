// What a user may choose of a render, before the scene and the defaults say the rest.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "settings/settings.h"

namespace phlux::settings {

struct Choices {
  std::map<std::string, std::string> definitions; ///< of the scene's $names
  std::optional<std::array<int, 2>> size;         ///< width, height
  std::map<std::string, std::string> texts;       ///< of the settings that are chosen, by their names

  /// @throws UsageError "`NAME` TEXT: what would be right"
  void choose(const Setting& setting, const std::string& text);
  [[nodiscard]] bool has(const std::string& name) const { return texts.contains(name); }
  /// Whether it is said how much to render.
  [[nodiscard]] bool has_amount() const;

  /// Chooses as `earlier` what is absent here. How much to render is one choice.
  void complete(const Choices& earlier);
};

/// `defaults`, with what the scene says in place of some and what the user chose in place of others.
/// @throws UsageError for choices that do not go together
[[nodiscard]] Settings settings_of(const Choices& choices, const scene::RenderDefaults& scene,
                                   Settings defaults = {});

} // namespace phlux::settings
