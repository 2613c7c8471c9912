// Writes the text of a scene file: elements, properties and colours in all permitted spellings.
#pragma once

#include <string>
#include <string_view>

#include "random/random_numbers.h"
#include "scene/scene.h"

namespace phlux::test {

class SceneText {
public:
  /// Names are in snake_case from version 2 on, in camelCase in 0.5 and 0.6. `random` chooses among
  /// equivalent forms.
  SceneText(std::string version, RandomNumbers& random);

  void open(const std::string& tag, const std::string& attributes);
  void close(const std::string& tag);
  void line(const std::string& element);

  // Properties by their names in snake_case.
  void real(std::string_view name, double value);
  void integer(std::string_view name, int value);
  void boolean(std::string_view name, bool value);
  void string(std::string_view name, const std::string& value);
  void color(std::string_view name, const scene::Rgb& value);
  void point(std::string_view name, const scene::Vec3& value);
  /// <translate>, <scale> or <vector name="...">, as three attributes or three numbers in one.
  void triple(const std::string& tag_and_name, const scene::Vec3& value);

  [[nodiscard]] std::string spelling(std::string_view snake_case) const;
  [[nodiscard]] static std::string number(double value);
  [[nodiscard]] static std::string numbers(const scene::Vec3& value, const char* between = ", ");

  /// The whole file.
  [[nodiscard]] std::string text() const;

private:
  /// The number, or the name of a parameter with this value.
  std::string written(const std::string& number);

  std::string version_, defaults_, body_;
  RandomNumbers& random_;
  int depth_ = 1, parameters_ = 0;
};

} // namespace phlux::test
