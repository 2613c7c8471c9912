// The scene file as a tree of elements with their lines, parameters substituted and references checked.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene_file/location.h"

namespace phlux::scene_file {

struct Element {
  std::string tag;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
  Location where;

  /// The attribute's value, empty if it is absent.
  [[nodiscard]] const std::string& operator[](const std::string& attribute) const;
  [[nodiscard]] bool has(const std::string& attribute) const { return attributes.contains(attribute); }
  /// The object's plugin, in lower case, as Mitsuba ignores case.
  [[nodiscard]] std::string type() const;
  /// <bsdf type="phong">, for messages
  [[nodiscard]] std::string name() const;
};

struct Document {
  mutable std::vector<std::filesystem::path> files; ///< the scene file, and those of path_of()
  Element scene;
  int major_version = 0;                         ///< 0: the names are Mitsuba 0.5's and 0.6's
  std::map<std::string, const Element*> objects; ///< by id; they point into `scene`

  /// The object that a <ref> refers to; any other element itself.
  [[nodiscard]] const Element& resolve(const Element& element) const;
  /// The path of a file that the scene names, relative to the scene's folder. Every file that is read must
  /// come from here: no output may replace a file of `files`.
  [[nodiscard]] std::filesystem::path path_of(const std::string& name) const;
  /// A property's name in the spelling of the file's version.
  [[nodiscard]] std::string spelling(const std::string& snake_case) const;

  Document() = default;
  Document(const Document&) = delete; ///< `objects` points into `scene`
  Document& operator=(const Document&) = delete;
};

/// Reads FILE into `document`. Time and memory are linear in the file's size: at most 64 MB and 100 times
/// that size.
/// @throws SceneError for malformed XML, unknown elements or attributes, an unknown version, duplicate ids,
/// and references that are circular or to unknown ids
void read_document(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions,
                   Document& document);

} // namespace phlux::scene_file
