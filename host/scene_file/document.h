// The scene file as a tree of elements with their lines, parameters substituted and references checked.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scene_file/problems.h"
#include "scene_file/warnings.h"

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
  std::filesystem::path file; ///< of the scene
  /// That file, and those of find(), from which every file that is read must come: no output may replace
  /// one of them.
  mutable std::vector<std::filesystem::path> files;
  Element scene;
  int major_version = 0;                         ///< 0: the names are Mitsuba 0.5's and 0.6's
  std::map<std::string, const Element*> objects; ///< by id; they point into `scene`
  std::set<const Element*> referred_to;          ///< objects that a <ref> names
  std::vector<std::filesystem::path>
      folders; ///< in which other files are sought in this order, the scene's own last
  /// What has been found wrong so far; also readers to whom the document is const add to it.
  const std::unique_ptr<Problems> problems = std::make_unique<Problems>();
  /// Shared with the requests of mesh files, which are read later.
  const std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();

  /// The object that a <ref> refers to; any other element, and a <ref> to nothing, itself.
  [[nodiscard]] const Element& resolve(const Element& element) const;
  /// The file of this name in the first folder that has it, else in the scene's own.
  [[nodiscard]] std::filesystem::path find(const std::string& name) const;
  /// note(), unless it has been called with this message before.
  void note_once(const Location& where, const std::string& message) const;
  /// A property's name in the spelling of the file's version.
  [[nodiscard]] std::string spelling(const std::string& snake_case) const;

  Document() = default;
  Document(const Document&) = delete; ///< `objects` points into `scene`
  Document& operator=(const Document&) = delete;

private:
  const std::unique_ptr<std::set<std::string>> noted_ = std::make_unique<std::set<std::string>>();
};

/// Reads FILE into `document`. Unknown elements and attributes and references to unknown ids are added to its
/// problems. Time and memory are linear in the file's size: at most 64 MB and 100 times that size.
/// @throws SceneError for malformed XML, an unknown version, duplicate ids and circular references
void read_document(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions,
                   Document& document);

} // namespace phlux::scene_file
