#include "scene_file/document_reader.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <pugixml.hpp>

#include "input_file.h"
#include "scene_file/parameters.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using Attributes = std::set<std::string>;

constexpr int deepest = 32;                 ///< levels of nesting; a valid scene has at most 8
constexpr std::size_t most_includes = 1000; ///< of all files, since a file may be included repeatedly
constexpr std::size_t most_folders = 1000;  ///< by <path>: every file is sought in each of them

const Attributes& object_tags() {
  static const Attributes names{"sensor",  "film",   "rfilter", "sampler", "integrator", "bsdf",      "shape",
                                "emitter", "medium", "phase",   "volume",  "texture",    "subsurface"};
  return names;
}

const std::map<std::string, Attributes>& known_elements() {
  static const std::map<std::string, Attributes> elements = [] {
    const Attributes value{"name", "value"}, step{"x", "y", "z", "value"};
    const Attributes triple{"name", "x", "y", "z", "value"};
    std::map<std::string, Attributes> known{
        {"scene", {"version"}},
        {"default", value},
        {"ref", {"id", "name"}},
        {"alias", {"id", "as"}},
        {"include", {"filename"}},
        {"path", {"value"}},
        {"boolean", value},
        {"integer", value},
        {"float", value},
        {"string", value},
        {"point", triple},
        {"vector", triple},
        {"rgb", {"name", "value", "intent"}},
        {"srgb", value},
        {"xyz", value},
        {"blackbody", {"name", "temperature", "scale"}},
        {"spectrum", {"name", "value", "intent", "filename", "type", "id"}},
        {"transform", {"name"}},
        {"translate", step},
        {"scale", step},
        {"rotate", {"x", "y", "z", "value", "angle"}},
        {"lookat", {"origin", "target", "up"}},
        {"matrix", {"value"}}};
    for (const auto& tag : object_tags()) known[tag] = {"type", "id", "name"};
    return known;
  }();
  return elements;
}

bool is_container(const std::string& tag) {
  return tag == "scene" || tag == "transform" || tag == "spectrum" || is_object_tag(tag);
}

std::string supported_elements() {
  static const Attributes objects_without_support{"medium", "phase", "volume", "subsurface"};
  std::vector<std::string> names;
  for (const auto& [name, attributes] : known_elements())
    if (!objects_without_support.contains(name)) names.push_back(name);
  return "supported are " + join(names);
}

/// A file with the positions of its lines.
class File {
public:
  File(const std::filesystem::path& path, const Location& named_at)
      : name_(std::make_shared<const std::string>(path.string())) {
    auto text = bytes_of(path);
    const bool is_main = named_at.line == 0;
    if (!text)
      fail(named_at, is_main ? "cannot be read" : "'" + path.string() + "' cannot be read",
           "an existing Mitsuba scene file is needed");
    if (is_utf16(*text)) fail({name_, 1}, "is in UTF-16", "save it as UTF-8");
    text_ = std::move(*text);
    for (std::size_t i = 0; i < text_.size(); ++i)
      if (text_[i] == '\n') line_ends_.push_back(i);
  }

  [[nodiscard]] Location at(std::ptrdiff_t offset) const {
    const auto line =
        std::ranges::lower_bound(line_ends_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0))) -
        line_ends_.begin();
    return {name_, static_cast<int>(line) + 1};
  }

  /// The outermost element. @throws SceneError unless it is <scene>, or an object in an included file
  pugi::xml_node parse(pugi::xml_document& xml, bool is_included) const {
    const auto result = xml.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
      fail(at(result.offset), std::string("malformed XML (") + result.description() + ")", "well-formed XML");
    pugi::xml_node root = xml.document_element();
    const bool is_object = is_included && is_object_tag(root.name());
    if (is_object) root.remove_attribute("version"); // that of the scene counts
    if ((std::string(root.name()) != "scene" && !is_object) || root.next_sibling())
      fail(at(root.offset_debug()), "the file's only outermost element must be <scene>",
           "<scene version=\"0.6.0\">...</scene>");
    return root;
  }

private:
  std::shared_ptr<const std::string> name_;
  std::string text_;
  std::vector<std::size_t> line_ends_;
};

class Reader {
public:
  Reader(Document& document, const std::map<std::string, std::string>& definitions)
      : document_(document), parameters_(definitions) {}

  Element scene() {
    const Location whole{std::make_shared<const std::string>(document_.file.string()), 0};
    Element element = read_file(document_.file, whole);
    if (parameters_.any_unknown()) document_.problems->throw_if_any(); // values are missing
    parameters_.check_all_used(whole);
    return element;
  }

private:
  Element read_file(const std::filesystem::path& path, const Location& named_at) {
    const File file(path, named_at);
    std::error_code ignored;
    const auto canonical = std::filesystem::weakly_canonical(path, ignored);
    if (std::ranges::find(open_, canonical) != open_.end())
      fail(named_at, "'" + path.string() + "' includes itself", "a file may not contain itself");
    if (++included_ > most_includes)
      fail(named_at, "too many files are included", "at most " + std::to_string(most_includes));
    pugi::xml_document xml;
    const pugi::xml_node root = file.parse(xml, !open_.empty());
    open_.push_back(canonical);
    Element element;
    if (std::string(root.name()) == "scene")
      element = convert(file, root, 0);
    else
      element.children.push_back(convert(file, root, 0)); // an included object
    open_.pop_back();
    return element;
  }

  Element without_children(const File& file, const pugi::xml_node& node, bool collect_problems = true) {
    Element element;
    element.tag = node.name();
    if (element.tag == "lookAt") element.tag = "lookat";
    element.where = file.at(node.offset_debug());
    const auto known = known_elements().find(element.tag);
    if (known == known_elements().end())
      fail(element.where, "element <" + element.tag + "> is not supported", supported_elements());
    for (const auto attribute : node.attributes()) {
      const auto add = [&] { add_attribute(element, known->second, attribute.name(), attribute.value()); };
      collect_problems ? document_.problems->attempt(add) : add();
    }
    return element;
  }

  Element convert(const File& file, const pugi::xml_node& node, int depth) {
    Element element = without_children(file, node);
    if (depth > deepest)
      fail(element.where, "elements are nested too deeply", "at most " + std::to_string(deepest) + " levels");
    for (const auto child : node.children())
      document_.problems->attempt([&] { add_child(file, element, child, depth); });
    return element;
  }

  void add_child(const File& file, Element& element, const pugi::xml_node& child, int depth) {
    const Location where = file.at(child.offset_debug());
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      fail(where, "text inside <" + element.tag + ">", "only elements and comments may stand there");
    if (child.type() != pugi::node_element) return;
    if (std::string_view(child.name()) == "default") return set_default(file, child);
    if (!is_container(element.tag))
      fail(where, "element inside <" + element.tag + ">", "it contains nothing");
    Element converted = convert(file, child, depth + 1);
    if (converted.tag == "include")
      include(element, converted);
    else if (converted.tag == "path")
      add_folder(converted);
    else
      element.children.push_back(std::move(converted));
  }

  void include(Element& element, const Element& statement) {
    if (statement["filename"].empty())
      fail(statement.where, "<include> without a filename", "<include filename=\"...\"/>");
    // As in Mitsuba 3, first beside the file that includes it.
    std::error_code ignored;
    const std::filesystem::path beside = open_.back().parent_path() / statement["filename"];
    Element included =
        read_file(std::filesystem::exists(beside, ignored) ? document_.files.emplace_back(beside)
                                                           : document_.find(statement["filename"]),
                  statement.where);
    std::ranges::move(included.children, std::back_inserter(element.children));
  }

  /// As in Mitsuba 3, files are sought in the folder of the last <path> first.
  void add_folder(const Element& statement) {
    const std::filesystem::path folder = document_.find(statement["value"]);
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
      fail(statement.where, "<path>: '" + statement["value"] + "' is no folder", "an existing folder");
    std::vector<std::filesystem::path>& folders = document_.folders;
    if (folders.front() == folder) return;
    const auto own = folders.end() - 1; // remains the last
    folders.erase(std::remove(folders.begin(), own, folder), own);
    if (folders.size() > most_folders)
      fail(statement.where, "more than " + std::to_string(most_folders) + " folders by <path>",
           "fewer folders");
    folders.insert(folders.begin(), folder);
  }

  void add_attribute(Element& element, const Attributes& known, const std::string& name,
                     const std::string& value) {
    if (!known.contains(name))
      fail(element.where, "attribute '" + name + "' of <" + element.tag + "> is not supported",
           "supported are " + join({known.begin(), known.end()}));
    if (!element.attributes.emplace(name, parameters_.substitute(value, element.where)).second)
      fail(element.where, "attribute '" + name + "' is given twice", "give it once");
  }

  void set_default(const File& file, const pugi::xml_node& node) {
    const Element element = without_children(file, node, false);
    if (element["name"].empty() || !element.has("value"))
      fail(element.where, "<default> without a name or a value", "<default name=\"spp\" value=\"64\"/>");
    parameters_.set_default(element["name"], element["value"], element.where);
  }

  Document& document_;
  Parameters parameters_;
  std::vector<std::filesystem::path> open_; ///< the files that are being read, each included by the last
  std::size_t included_ = 0;
};

} // namespace

bool is_object_tag(const std::string& tag) {
  return object_tags().contains(tag);
}

Element read_elements(Document& document, const std::map<std::string, std::string>& definitions) {
  return Reader(document, definitions).scene();
}

} // namespace phlux::scene_file
