#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include "errors.h"
#include "lobes/models.h"

namespace phlux::lobes {
namespace {

constexpr const char* entry_syntax = "COLOUR or NUMBER(name, default, lowest, highest, \"meaning\")";

/// The #defines of a kernel file that declare a model.
class Defines {
public:
  Defines(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {
    for (std::size_t at = text_.find("\\\n"); at != std::string::npos; at = text_.find("\\\n", at))
      text_.replace(at, 2, "\f "); // joins continued lines and keeps positions
  }

  [[nodiscard]] bool has(const std::string& name) const {
    return std::regex_search(text_, std::regex("(^|\n)\\s*#\\s*define\\s+" + name + "\\b"));
  }
  [[nodiscard]] bool is_one(const std::string& name) const {
    return std::regex_search(text_, std::regex("(^|\n)\\s*#\\s*define\\s+" + name + "\\s+1\\s*(//|\n)"));
  }

  struct List {
    std::array<std::string, 2> kinds; ///< the names of the two parameters of the macro
    std::string body;
    std::size_t at = 0; ///< of the body in the text
  };
  [[nodiscard]] std::optional<List> list(const std::string& name) const {
    std::smatch found;
    const std::regex define("(^|\n)\\s*#\\s*define\\s+" + name +
                            "\\(\\s*(\\w+)\\s*,\\s*(\\w+)\\s*\\)([^\n]*)");
    if (!std::regex_search(text_, found, define)) return std::nullopt;
    return List{{found[2], found[3]}, found[4], static_cast<std::size_t>(found.position(4))};
  }

  [[noreturn]] void fail(std::size_t at, const std::string& wrong, const std::string& right) const {
    const auto until = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at, text_.size()));
    const auto line = 1 + std::count_if(text_.begin(), until, [](char c) { return c == '\n' || c == '\f'; });
    throw SceneError(fmt::format("{}:{}: {}: {}", file_, line, wrong, right));
  }

private:
  std::string file_, text_;
};

scene::Parameter read_entry(const Defines& defines, const Defines::List& list, const std::smatch& entry,
                            std::size_t at) {
  scene::Parameter parameter;
  if (entry[1] != list.kinds[0] && entry[1] != list.kinds[1])
    defines.fail(at, entry[1].str() + " is no kind of parameter", entry_syntax);
  parameter.kind =
      entry[1] == list.kinds[0] ? scene::Parameter::Kind::colour : scene::Parameter::Kind::number;
  parameter.name = entry[2];
  parameter.default_value = std::stod(entry[3]);
  parameter.lowest = std::stod(entry[4]);
  parameter.highest = std::stod(entry[5]);
  parameter.meaning = entry[6];
  if (!(parameter.lowest <= parameter.default_value && parameter.default_value <= parameter.highest))
    defines.fail(at, fmt::format("the default of {} is outside its range", parameter.name), entry_syntax);
  return parameter;
}

std::vector<scene::Parameter> read_parameters(const Defines& defines, const Defines::List& list) {
  constexpr const char* number = R"(\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*)";
  static const std::regex entry(
      fmt::format(R"re((\w+)\s*\(\s*(\w+)\s*,{0},{0},{0},\s*"([^"]*)"\s*\))re", number));
  static const std::regex blank("[\\s\f]*");
  std::vector<scene::Parameter> parameters;
  std::size_t end = 0;
  for (std::sregex_iterator each(list.body.begin(), list.body.end(), entry), none; each != none; ++each) {
    const auto at = static_cast<std::size_t>(each->position());
    const std::string between = list.body.substr(end, at - end);
    if (!std::regex_match(between, blank)) defines.fail(list.at + end, "this is no parameter", entry_syntax);
    parameters.push_back(read_entry(defines, list, *each, list.at + at));
    end = at + static_cast<std::size_t>(each->length());
  }
  if (!std::regex_match(list.body.substr(end), std::regex("[\\s\f]*(//.*)?")))
    defines.fail(list.at + end, "this is no parameter", entry_syntax);
  return parameters;
}

} // namespace

std::string macro_prefix(std::string model) {
  for (char& c : model) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return model;
}

scene::Model read_declaration(const std::string& name, const std::string& file, const std::string& text) {
  const Defines defines(file, text);
  const std::string prefix = macro_prefix(name);
  scene::Model model;
  model.name = name;
  model.file = file;
  const auto parameters = defines.list(prefix + "_PARAMETERS");
  if (!parameters)
    defines.fail(0, "there is no #define " + prefix + "_PARAMETERS(COLOUR, NUMBER)",
                 "a model " + name + " declares its parameters by it (kernels/lobes/lobe.h)");
  model.parameters = read_parameters(defines, *parameters);
  if (const auto derived = defines.list(prefix + "_DERIVED")) {
    const std::regex member(R"((\w+)\s*\(\s*\w+\s*\))");
    model.derived_words = static_cast<int>(
        std::distance(std::sregex_iterator(derived->body.begin(), derived->body.end(), member), {}));
  }
  model.has_delta = defines.is_one(prefix + "_HAS_DELTA");
  model.needs_tangents = defines.is_one(prefix + "_NEEDS_TANGENTS");
  model.reflectivity_is_estimate = defines.is_one(prefix + "_REFLECTIVITY_IS_ESTIMATE");
  model.has_survival = defines.has(prefix + "_SURVIVAL");
  model.has_textured = defines.has(prefix + "_TEXTURED");
  return model;
}

} // namespace phlux::lobes
