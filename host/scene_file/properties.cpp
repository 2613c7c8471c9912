#include "scene_file/properties.h"

#include <algorithm>
#include <cmath>

#include "scene_file/color.h"
#include "scene_file/named_media.h"
#include "scene_file/transform.h"
#include "scene_file/values.h"
#include "settings/values.h"

namespace phlux::scene_file {

namespace {

bool is_value(const Element& element) {
  static const std::set<std::string> tags{"boolean",  "integer",   "float",     "string",
                                          "point",    "vector",    "rgb",       "srgb",
                                          "spectrum", "blackbody", "transform", "xyz"};
  return tags.contains(element.tag);
}

const std::string& value_of(const Element& property) {
  if (!property.has("value"))
    fail(property.where, property.name() + " without a value", "value=\"...\" is needed");
  return property["value"];
}

} // namespace

Properties::Properties(const Element& object, const Document& document)
    : object_(object), document_(document) {
  for (const auto& child : object.children) {
    if (!is_property(child)) continue;
    const Element& property = document.resolve(child);
    if (child["name"].empty())
      fail(child.where, "<" + child.tag + "> without a name", "name=\"...\" says which property it is");
    const auto [first, inserted] = properties_.emplace(to_snake_case(child["name"]), &property);
    if (!inserted)
      fail(child.where, "'" + child["name"] + "' is given twice",
           "the first is on line " + std::to_string(first->second->where.line) + "; give it once");
  }
}

bool Properties::is_property(const Element& child) const {
  return is_value(child) ||
         (object_.tag != "scene" && object_.tag != "texture" && document_.resolve(child).tag == "texture");
}

const Element* Properties::find(const std::string& name, std::initializer_list<const char*> tags) {
  asked_.insert(name);
  const auto found = properties_.find(name);
  if (found == properties_.end()) return nullptr;
  const Element& property = *found->second;
  if (std::ranges::find(tags, property.tag) == tags.end()) {
    std::vector<std::string> expected;
    for (const char* tag : tags) expected.push_back("<" + std::string(tag) + ">");
    fail(property.where, "'" + property["name"] + "' is a <" + property.tag + ">",
         "it must be one of " + join(expected));
  }
  return &property;
}

bool Properties::has(const std::string& name) {
  asked_.insert(name);
  return properties_.contains(name);
}

double Properties::real(const std::string& name, double otherwise) {
  const Element* property = find(name, {"float", "integer"});
  if (!property) return otherwise;
  const auto value = parse_real(value_of(*property));
  if (!value)
    fail_at(name, "'" + value_of(*property) + "' is not a number", "a finite number within single precision");
  return *value;
}

double Properties::index_of_refraction(const std::string& name, double otherwise) {
  const Element* property = find(name, {"float", "integer", "string"});
  if (!property || property->tag != "string") return real(name, otherwise);
  const auto index = index_of_dielectric(value_of(*property));
  if (!index)
    fail_at(name, "no dielectric is named '" + value_of(*property) + "'",
            "a number, or one of " + names_of_dielectrics());
  return *index;
}

int Properties::integer(const std::string& name, int otherwise) {
  const Element* property = find(name, {"integer"});
  if (!property) return otherwise;
  const auto value = parse_integer(value_of(*property));
  if (!value)
    fail_at(name, "'" + value_of(*property) + "' is not an integer", "a whole number of at most 31 bits");
  return *value;
}

bool Properties::boolean(const std::string& name, bool otherwise) {
  const Element* property = find(name, {"boolean"});
  if (!property) return otherwise;
  // Mitsuba 2 and 3 ignore case, as Python writes True; 0.x does not.
  const std::string value =
      document_.major_version == 0 ? value_of(*property) : to_lower(value_of(*property));
  if (value != "true" && value != "false") fail_at(name, "'" + value + "' is not a boolean", "true or false");
  return value == "true";
}

std::string Properties::string(const std::string& name, const std::string& otherwise) {
  const Element* property = find(name, {"string"});
  return property ? value_of(*property) : otherwise;
}

std::optional<scene::Vec3> Properties::vector(const std::string& name) {
  const Element* property = find(name, {"point", "vector"});
  if (!property) return std::nullopt;
  return read_triple(*property, 0.0);
}

scene::Rgb Properties::color(const std::string& name, const scene::Rgb& otherwise, double most) {
  const Element* property = find(name, {"rgb", "srgb", "spectrum", "float", "blackbody", "xyz"});
  const bool emission = object_.tag == "emitter";
  return property ? read_color(*property, document_, emission, emission ? HUGE_VAL : most) : otherwise;
}

const Element* Properties::texture(const std::string& name) {
  asked_.insert(name);
  const auto found = properties_.find(name);
  return found != properties_.end() && found->second->tag == "texture" ? found->second : nullptr;
}

glm::dmat4 Properties::transform(const std::string& name) {
  const Element* property = find(name, {"transform"});
  return property ? read_transform(*property, document_.major_version) : glm::dmat4(1.0);
}

std::vector<std::pair<std::string, const Element*>> Properties::named_objects(const std::string& tag) {
  asked_objects_.insert(tag);
  std::vector<std::pair<std::string, const Element*>> found;
  for (const auto& child : object_.children)
    if (!is_property(child) && document_.resolve(child).tag == tag)
      found.emplace_back(child["name"], &document_.resolve(child));
  return found;
}

std::vector<const Element*> Properties::objects(const std::string& tag) {
  std::vector<const Element*> found;
  for (const auto& [name, object] : named_objects(tag)) found.push_back(object);
  return found;
}

const Element* Properties::object(const std::string& tag) {
  const auto found = objects(tag);
  if (found.size() > 1)
    fail(found[1]->where, object_.name() + " has more than one <" + tag + ">", "give one");
  return found.empty() ? nullptr : found.front();
}

void Properties::pass_over(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    asked_.insert(name);
    const auto found = properties_.find(name);
    if (found != properties_.end())
      note(found->second->where,
           "'" + (*found->second)["name"] + "' cannot change the image and is passed over");
  }
}

void Properties::pass_over_rest() {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const auto& [name, property] : properties_) {
    if (asked_.contains(name)) continue;
    const std::string meant = settings::nearest(name, known);
    if (!meant.empty())
      fail_at(name, "is not a property of " + object_.name(), "did you mean " + spelling(meant) + "?");
    asked_.insert(name);
    note(property->where, "'" + (*property)["name"] + "' is not used");
  }
}

void Properties::require(const std::string& name, bool value) {
  if (boolean(name, value) != value)
    fail_at(name, "'" + spelling(name) + "' is not supported",
            std::string("leave it out, or ") + (value ? "true" : "false"));
}

void Properties::finish() {
  for (const auto& child : object_.children)
    document_.problems->attempt([&] { is_property(child) ? check_known(child) : check_allowed(child); });
}

void Properties::check_known(const Element& property) const {
  if (asked_.contains(to_snake_case(property["name"]))) return;
  std::vector<std::string> names;
  for (const auto& name : asked_) names.push_back(spelling(name));
  fail(property.where, "'" + property["name"] + "' is not a property of " + object_.name(),
       names.empty() ? "it has none" : "supported are " + join(names));
}

void Properties::check_allowed(const Element& nested) const {
  const Element& object = document_.resolve(nested);
  if (asked_objects_.contains(object.tag) || object.tag == "ref" || object.tag == "alias") return;
  if (object_.tag == "scene" && object.has("id")) { // the reader of what refers to it has checked it
    if (!document_.referred_to.contains(&object)) note(object.where, object.name() + " is used nowhere");
    return;
  }
  fail(nested.where, object.name() + " inside " + object_.name() + " is not supported",
       asked_objects_.empty() ? "it contains no other object"
                              : "it may contain " + join({asked_objects_.begin(), asked_objects_.end()}));
}

const Location& Properties::where(const std::string& name) const {
  const auto found = properties_.find(name);
  return found == properties_.end() ? object_.where : found->second->where;
}

void Properties::fail_at(const std::string& name, const std::string& wrong, const std::string& right) {
  fail(where(name), object_.name() + ": " + spelling(name) + ": " + wrong, right);
}

} // namespace phlux::scene_file
