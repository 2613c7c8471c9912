#include "scene_file/document.h"

#include <algorithm>
#include <set>

#include <pugixml.hpp>

#include "errors.h"
#include "input_file.h"
#include "scene_file/parameters.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using Attributes = std::set<std::string>;

constexpr std::size_t deepest =
    32; ///< levels of nesting, also by references, to bound the recursion; a valid scene has at most 6

const std::map<std::string, Attributes>& known_elements() {
  static const Attributes object{"type", "id", "name"}, value{"name", "value"};
  static const Attributes triple{"name", "x", "y", "z", "value"}, step{"x", "y", "z", "value"};
  static const std::map<std::string, Attributes> elements{{"scene", {"version"}},
                                                          {"default", value},
                                                          {"ref", {"id", "name"}},
                                                          {"sensor", object},
                                                          {"film", object},
                                                          {"rfilter", object},
                                                          {"sampler", object},
                                                          {"integrator", object},
                                                          {"bsdf", object},
                                                          {"shape", object},
                                                          {"emitter", object},
                                                          {"boolean", value},
                                                          {"integer", value},
                                                          {"float", value},
                                                          {"string", value},
                                                          {"point", triple},
                                                          {"vector", triple},
                                                          {"rgb", {"name", "value", "intent"}},
                                                          {"srgb", value},
                                                          {"spectrum", {"name", "value", "intent"}},
                                                          {"transform", {"name"}},
                                                          {"translate", step},
                                                          {"scale", step},
                                                          {"rotate", {"x", "y", "z", "value", "angle"}},
                                                          {"lookat", {"origin", "target", "up"}},
                                                          {"matrix", {"value"}}};
  return elements;
}

const Attributes& containers() {
  static const Attributes names{"scene",      "sensor", "film",  "rfilter", "sampler",
                                "integrator", "bsdf",   "shape", "emitter", "transform"};
  return names;
}

std::string supported_elements() {
  std::vector<std::string> names;
  for (const auto& [name, attributes] : known_elements()) names.push_back(name);
  return "supported are " + join(names);
}

class Reader {
public:
  Reader(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions)
      : file_(std::make_shared<const std::string>(file.string())), parameters_(definitions) {
    auto text = bytes_of(file);
    if (!text) fail({file_, 0}, "cannot be read", "an existing Mitsuba scene file is needed");
    if (is_utf16(*text)) fail({file_, 1}, "is in UTF-16", "save it as UTF-8");
    text_ = std::move(*text);
    for (std::size_t i = 0; i < text_.size(); ++i)
      if (text_[i] == '\n') line_ends_.push_back(i);
  }

  Element scene() {
    pugi::xml_document xml;
    const auto result = xml.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
      fail(at(result.offset), std::string("malformed XML (") + result.description() + ")", "well-formed XML");
    const pugi::xml_node root = xml.document_element();
    if (std::string(root.name()) != "scene" || root.next_sibling())
      fail(at(std::max<std::ptrdiff_t>(root.offset_debug(), 0)),
           "the file's only outermost element must be <scene>", "<scene version=\"0.6.0\">...</scene>");
    for (const auto& found : root.select_nodes(".//default")) set_default(found.node());
    Element element = convert(root);
    parameters_.check_all_used({file_, 0});
    return element;
  }

private:
  [[nodiscard]] Location at(std::ptrdiff_t offset) const {
    const auto line =
        std::ranges::lower_bound(line_ends_, static_cast<std::size_t>(offset)) - line_ends_.begin();
    return {file_, static_cast<int>(line) + 1};
  }

  Element without_children(const pugi::xml_node& node) {
    Element element;
    element.tag = node.name();
    if (element.tag == "lookAt") element.tag = "lookat";
    element.where = at(node.offset_debug());
    const auto known = known_elements().find(element.tag);
    if (known == known_elements().end())
      fail(element.where, "element <" + element.tag + "> is not supported", supported_elements());
    for (const auto attribute : node.attributes())
      add_attribute(element, known->second, attribute.name(), attribute.value());
    return element;
  }

  Element convert(const pugi::xml_node& node, std::size_t depth = 0) {
    Element element = without_children(node);
    if (depth > deepest)
      fail(element.where, "elements are nested too deeply", "at most " + std::to_string(deepest) + " levels");
    for (const auto child : node.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        fail(at(child.offset_debug()), "text inside <" + element.tag + ">",
             "only elements and comments may stand there");
      if (child.type() != pugi::node_element) continue;
      if (!containers().contains(element.tag))
        fail(at(child.offset_debug()), "element inside <" + element.tag + ">", "it contains nothing");
      if (std::string_view(child.name()) != "default") element.children.push_back(convert(child, depth + 1));
    }
    return element;
  }

  void add_attribute(Element& element, const Attributes& known, const std::string& name,
                     const std::string& value) {
    if (!known.contains(name))
      fail(element.where, "attribute '" + name + "' of <" + element.tag + "> is not supported",
           "supported are " + join({known.begin(), known.end()}));
    if (!element.attributes.emplace(name, parameters_.substitute(value, element.where)).second)
      fail(element.where, "attribute '" + name + "' is given twice", "give it once");
  }

  void set_default(const pugi::xml_node& node) {
    const Element element = without_children(node);
    if (element["name"].empty() || !element.has("value"))
      fail(element.where, "<default> without a name or a value", "<default name=\"spp\" value=\"64\"/>");
    parameters_.set_default(element["name"], element["value"], element.where);
  }

  std::shared_ptr<const std::string> file_;
  Parameters parameters_;
  std::string text_;
  std::vector<std::size_t> line_ends_;
};

int major_version(const Element& scene) {
  const std::string& version = scene["version"];
  const auto dot = version.find('.');
  const auto major = parse_integer(version.substr(0, dot));
  const std::string rest = dot == std::string::npos ? "" : version.substr(dot + 1);
  const auto minor = parse_integer(rest.substr(0, rest.find('.')));
  const bool known =
      major && (*major == 2 || *major == 3 || (*major == 0 && minor && (*minor == 5 || *minor == 6)));
  if (!known)
    fail(scene.where,
         version.empty() ? "the scene states no version" : "scene version '" + version + "' is not supported",
         "versions 0.5, 0.6, 2.x and 3.x are read");
  return *major;
}

void collect_ids(const Element& element, std::map<std::string, const Element*>& objects) {
  if (element.tag != "ref" && element.has("id")) {
    const auto [first, inserted] = objects.emplace(element["id"], &element);
    if (!inserted)
      fail(element.where, "id '" + element["id"] + "' is used twice",
           "the first is on line " + std::to_string(first->second->where.line) +
               "; every id must be its own");
  }
  for (const auto& child : element.children) collect_ids(child, objects);
}

void check_references(const Document& document, const Element& element, std::vector<const Element*>& above,
                      std::set<const Element*>& checked) {
  if (element.tag == "ref") {
    const Element& target = document.resolve(element);
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
  if (element.tag != "ref") return element;
  const auto found = objects.find(element["id"]);
  if (found == objects.end()) {
    std::vector<std::string> ids;
    for (const auto& [id, object] : objects) ids.push_back(id);
    fail(element.where, "reference to '" + element["id"] + "', which is not in the file",
         ids.empty() ? "no object has an id" : "the ids are " + join(ids));
  }
  return *found->second;
}

std::filesystem::path Document::path_of(const std::string& name) const {
  return files.emplace_back(files.front().parent_path() / name);
}

std::string Document::spelling(const std::string& snake_case) const {
  return major_version == 0 ? to_camel_case(snake_case) : snake_case;
}

void read_document(const std::filesystem::path& file, const std::map<std::string, std::string>& definitions,
                   Document& document) {
  document.files = {file};
  document.scene = Reader(file, definitions).scene();
  document.major_version = major_version(document.scene);
  collect_ids(document.scene, document.objects);
  std::vector<const Element*> above;
  std::set<const Element*> checked;
  check_references(document, document.scene, above, checked);
}

} // namespace phlux::scene_file
