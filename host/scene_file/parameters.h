// Substitution of `$name` in a scene file: by -D name=value, else <default name="..." value="..."/>.
#pragma once

#include <map>
#include <set>
#include <string>

#include "scene_file/location.h"

namespace phlux::scene_file {

class Parameters {
public:
  explicit Parameters(std::map<std::string, std::string> definitions)
      : values_(definitions), defined_(std::move(definitions)) {}

  /// Sets the value of a <default>, unless -D or an earlier <default> has set it.
  void set_default(const std::string& name, const std::string& value);

  /// `text` with every $name replaced by its value; the longest matching name is taken.
  /// @throws SceneError if no known name follows a $
  [[nodiscard]] std::string substitute(const std::string& text, const Location& where);

  /// Whether substitute() has thrown.
  [[nodiscard]] bool any_unknown() const { return any_unknown_; }

  /// @throws SceneError if a -D was never used, as when its name is misspelt
  void check_all_used(const Location& file) const;

private:
  std::map<std::string, std::string> values_;
  std::map<std::string, std::string> defined_; ///< from -D alone
  std::set<std::string> used_;
  bool any_unknown_ = false;
};

} // namespace phlux::scene_file
