// `$name` in a scene file: -D name=value, else the file's own <default name="..." value="..."/>.
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

  /// What <default> says; a definition given before, by -D or by an earlier <default>, stays.
  void set_default(const std::string& name, const std::string& value);

  /// `text` with every $name replaced; where several names fit, the longest is meant.
  /// @throws SceneError where no known name follows a $
  [[nodiscard]] std::string substitute(const std::string& text, const Location& where);

  /// @throws SceneError if a -D was never used: its name is misspelt, or the scene cannot be changed in this
  /// way
  void check_all_used(const Location& file) const;

private:
  std::map<std::string, std::string> values_;
  std::map<std::string, std::string> defined_; ///< from -D alone
  std::set<std::string> used_;
};

} // namespace phlux::scene_file
