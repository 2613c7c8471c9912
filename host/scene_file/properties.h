// The named values of one object of the scene file. What was asked for is what is supported: everything else
// that the file gives is an error, so that a misspelt name does not pass silently.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

class Properties {
public:
  /// @throws SceneError for properties without a name, and names given twice
  Properties(const Element& object, const Document& document);

  // Each takes the name in snake_case, finds it in either spelling, and throws SceneError at the property's
  // line if it is of another type, malformed or out of range.
  [[nodiscard]] bool has(const std::string& name);
  [[nodiscard]] double real(const std::string& name, double otherwise);
  [[nodiscard]] int integer(const std::string& name, int otherwise);
  [[nodiscard]] bool boolean(const std::string& name, bool otherwise);
  [[nodiscard]] std::string string(const std::string& name, const std::string& otherwise);
  [[nodiscard]] std::optional<scene::Vec3> vector(const std::string& name);
  [[nodiscard]] scene::Rgb color(const std::string& name, const scene::Rgb& otherwise);
  /// Affine and invertible; the identity if the file gives none.
  [[nodiscard]] glm::dmat4 transform(const std::string& name);

  /// The objects nested in this one, directly or through <ref>, whose element is <tag>.
  [[nodiscard]] std::vector<const Element*> objects(const std::string& tag);
  /// The one such object, or null. @throws SceneError if there are several
  [[nodiscard]] const Element* object(const std::string& tag);

  /// Names that cannot change the image: each that the file gives is passed over with a note.
  void pass_over(std::initializer_list<const char*> names);
  /// Everything that was never asked for.
  void pass_over_rest();
  /// A switch that is not supported unless it is `value`, which changes nothing.
  void require(const std::string& name, bool value);
  /// @throws SceneError for the first property or nested object that was never asked for
  void finish();

  /// @throws SceneError at the property's line, or at the object's if the file does not give it
  [[noreturn]] void fail_at(const std::string& name, const std::string& wrong, const std::string& right);
  [[nodiscard]] const Location& where(const std::string& name) const; ///< as fail_at
  [[nodiscard]] const Element& element() const { return object_; }
  [[nodiscard]] const Document& document() const { return document_; }
  /// `name` as this file's version spells it
  [[nodiscard]] std::string spelling(const std::string& name) const { return document_.spelling(name); }

private:
  const Element* find(const std::string& name, std::initializer_list<const char*> tags);

  const Element& object_;
  const Document& document_;
  std::map<std::string, const Element*> properties_; ///< by snake_case name
  std::set<std::string> asked_, asked_objects_;
};

} // namespace phlux::scene_file
