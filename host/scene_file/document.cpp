#include "scene_file/document.h"

#include <algorithm>
#include <set>

#include "scene_file/document_reader.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

/// Levels of nesting by references, to bound the recursion; a valid scene has at most 6.
constexpr std::size_t deepest = 32;

int major_version(const Element& scene) {
  const std::string& version = scene["version"];
  const auto dot = version.find('.');
  const auto major = parse_integer(version.substr(0, dot));
  const std::string rest = dot == std::string::npos ? "" : version.substr(dot + 1);
  const auto minor = parse_integer(rest.substr(0, rest.find('.')));
  const bool known =
      major && (*major == 2 || *major == 3 || (*major == 0 && minor && *minor >= 4 && *minor <= 6));
  if (!known)
    fail(scene.where,
         version.empty() ? "the scene states no version" : "scene version '" + version + "' is not supported",
         "versions 0.4, 0.5, 0.6, 2.x and 3.x are read");
  return *major;
}

void collect_ids(const Element& element, std::map<std::string, const Element*>& objects) {
  if (element.tag != "ref" && element.tag != "alias" && element.has("id")) {
    const auto [first, inserted] = objects.emplace(element["id"], &element);
    if (!inserted)
      fail(element.where, "id '" + element["id"] + "' is used twice",
           "the first is on line " + std::to_string(first->second->where.line) +
               "; every id must be its own");
  }
  for (const auto& child : element.children) collect_ids(child, objects);
}

[[noreturn]] void fail_unknown(const Document& document, const Element& reference) {
  constexpr std::size_t most = 16;
  std::vector<std::string> ids;
  for (const auto& [id, object] : document.objects) ids.push_back(id);
  if (ids.size() > most) {
    const std::string others = "and " + std::to_string(ids.size() - most) + " others";
    ids.resize(most);
    ids.push_back(others);
  }
  fail(reference.where, "reference to '" + reference["id"] + "', which is not in the file",
       ids.empty() ? "no object has an id" : "the ids are " + join(ids));
}

/// <alias id="ID" as="NAME"/> gives an object a second id.
void add_aliases(Document& document) {
  for (const auto& child : document.scene.children) {
    if (child.tag != "alias") continue;
    const auto object = document.objects.find(child["id"]);
    if (object == document.objects.end()) fail_unknown(document, child);
    document.objects.emplace(child["as"], object->second);
  }
}

void check_references(Document& document, const Element& element, std::vector<const Element*>& above,
                      std::set<const Element*>& checked) {
  if (element.tag == "ref") {
    const Element& target = document.resolve(element);
    if (&target == &element) document.problems->attempt([&] { fail_unknown(document, element); });
    if (&target == &element) return;
    document.referred_to.insert(&target);
    if (std::ranges::find(above, &target) != above.end())
      fail(element.where, "reference to '" + element["id"] + "' is circular",
           "an object may not contain itself");
    if (above.size() > deepest)
      fail(element.where, "references are nested too deeply",
           "at most " + std::to_string(deepest) + " levels");
    check_references(document, target, above, checked);
    return;
  }
  if (!checked.insert(&element).second) return;
  above.push_back(&element);
  for (const auto& child : element.children) check_references(document, child, above, checked);
  above.pop_back();
}

} // namespace

const std::string& Element::operator[](const std::string& attribute) const {
  static const std::string none;
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? none : found->second;
}

std::string Element::type() const {
  return to_lower((*this)["type"]);
}

std::string Element::name() const {
  return has("type") ? "<" + tag + " type=\"" + (*this)["type"] + "\">" : "<" + tag + ">";
}

const Element& Document::resolve(const Element& element) const {
  const auto found = element.tag == "ref" ? objects.find(element["id"]) : objects.end();
  return found == objects.end() ? element : *found->second;
}

std::filesystem::path Document::find(const std::string& name) const {
  std::string portable = name; // scenes that were written on Windows
  std::ranges::replace(portable, '\\', '/');
  std::error_code ignored;
  for (const auto& folder : folders)
    for (const auto& spelling : {name, portable})
      if (std::filesystem::exists(folder / spelling, ignored)) return files.emplace_back(folder / spelling);
  return files.emplace_back(folders.back() / name);
}

void Document::note_once(const Location& where, const std::string& message) const {
  if (noted_->insert(message).second) note(where, message);
}

std::string Document::spelling(const std::string& snake_case) const {
  return major_version == 0 ? to_camel_case(snake_case) : snake_case;
}

void read_document(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions,
                   Document& document) {
  document.file = file;
  document.files = {file};
  document.folders = {file.parent_path()};
  document.scene = read_elements(document, definitions);
  document.major_version = major_version(document.scene);
  collect_ids(document.scene, document.objects);
  add_aliases(document);
  std::vector<const Element*> above;
  std::set<const Element*> checked;
  check_references(document, document.scene, above, checked);
}

} // namespace phlux::scene_file
