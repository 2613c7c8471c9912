// Substitution of `$name` in a scene file: by a definition, else <default name="..." value="..."/>.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "scene_file/location.h"

namespace phlux::scene_file {

class Parameters {
public:
  /// Characters of a <default>'s name, of an attribute after substitution, and of all substituted values
  /// together: a few <default>s that repeat each other would otherwise fill any memory.
  static constexpr std::size_t longest_name = 255, longest_text = 1'000'000, most_substituted = 64'000'000;

  explicit Parameters(const std::map<std::string, std::string>& definitions)
      : values_(definitions.begin(), definitions.end()), defined_(definitions) {}

  /// Sets the value of a <default>, unless a definition or an earlier <default> has set it.
  /// @throws SceneError if its name is too long
  void set_default(const std::string& name, const std::string& value, const Location& where);

  /// `text` with every $name replaced by its value; the longest matching name is taken.
  /// @throws SceneError if no known name follows a $, or if the result is too long
  [[nodiscard]] std::string substitute(const std::string& text, const Location& where);

  /// Whether substitute() has thrown.
  [[nodiscard]] bool any_unknown() const { return any_unknown_; }

  /// @throws SceneError if a definition was never used, as when its name is misspelt
  void check_all_used(const Location& file) const;

private:
  using Values = std::map<std::string, std::string, std::less<>>;
  [[nodiscard]] const Values::value_type* longest_match(std::string_view text) const;

  Values values_;
  std::map<std::string, std::string> defined_; ///< from definitions alone
  std::set<std::string> used_;
  std::size_t substituted_ = 0; ///< characters
  bool any_unknown_ = false;
};

} // namespace phlux::scene_file
