// The named values of one object of the scene file. Names that the reader has not queried are not supported:
// finish() reports all of them, so that a misspelt name is not silently ignored.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "scene_file/document.h"

namespace phlux::scene_file {

class Properties {
public:
  /// @throws SceneError for properties without a name, and names given twice
  Properties(const Element& object, const Document& document);

  // Each takes the name in snake_case, finds it in either spelling, and returns `otherwise` if it is absent.
  // @throws SceneError at the property's line if it is of another type, malformed or out of range
  [[nodiscard]] bool has(const std::string& name);
  [[nodiscard]] double real(const std::string& name, double otherwise);
  /// A number, or the name of a dielectric for its index of refraction.
  [[nodiscard]] double index_of_refraction(const std::string& name, double otherwise);
  [[nodiscard]] int integer(const std::string& name, int otherwise);
  [[nodiscard]] bool boolean(const std::string& name, bool otherwise);
  [[nodiscard]] std::string string(const std::string& name, const std::string& otherwise);
  [[nodiscard]] std::optional<scene::Vec3> vector(const std::string& name);
  /// Channels of spectra above `most` become `most`, unless the object is an emitter.
  [[nodiscard]] scene::Rgb color(const std::string& name, const scene::Rgb& otherwise, double most = 1.0);
  /// The <texture> of this name, nested or by <ref>; null if there is none, or a property instead.
  [[nodiscard]] const Element* texture(const std::string& name);
  /// Affine and invertible; the identity if it is absent.
  [[nodiscard]] glm::dmat4 transform(const std::string& name);

  /// The objects <tag> nested in this one, directly or by <ref>.
  [[nodiscard]] std::vector<const Element*> objects(const std::string& tag);
  /// The same with the names that they have in this object, which may be empty.
  [[nodiscard]] std::vector<std::pair<std::string, const Element*>> named_objects(const std::string& tag);
  /// The only such object, or null. @throws SceneError if there are several
  [[nodiscard]] const Element* object(const std::string& tag);

  /// Ignores properties that cannot change the image, with a note for each.
  void pass_over(std::initializer_list<const char*> names);
  /// Ignores all properties that were not queried, with a note for each, unless they seem to be misspelt
  /// names of those that were.
  void pass_over_rest();
  /// Checks a boolean that is supported only with this value.
  void require(const std::string& name, bool value);
  /// Adds every property and nested object that was not queried to the document's problems.
  void finish();

  /// @throws SceneError at the property's line, or at the object's if it is absent
  [[noreturn]] void fail_at(const std::string& name, const std::string& wrong, const std::string& right);
  [[nodiscard]] const Location& where(const std::string& name) const; ///< as fail_at
  [[nodiscard]] const Element& element() const { return object_; }
  [[nodiscard]] const Document& document() const { return document_; }
  /// `name` in the spelling of the file's version
  [[nodiscard]] std::string spelling(const std::string& name) const { return document_.spelling(name); }

private:
  void check_known(const Element& property) const;
  void check_allowed(const Element& nested) const;
  /// Whether a child is a property: by its tag, or as a texture, which only scenes and other textures have by
  /// itself.
  [[nodiscard]] bool is_property(const Element& child) const;
  const Element* find(const std::string& name, std::initializer_list<const char*> tags);

  const Element& object_;
  const Document& document_;
  std::map<std::string, const Element*> properties_; ///< by snake_case name; references are resolved
  std::set<std::string> asked_, asked_objects_;
};

} // namespace phlux::scene_file
