#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <regex>
#include <string_view>
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

  [[nodiscard]] bool has(const std::string& name) const { return after_define(name).has_value(); }
  [[nodiscard]] bool is_one(const std::string& name) const {
    for (auto value = after_define(name); value; value = after_define(name, *value))
      if (trimmed(value->substr(0, value->find("//"))) == "1") return true;
    return false;
  }

  struct List {
    std::array<std::string, 2> kinds; ///< the names of the two parameters of the macro
    std::string body;
    std::size_t at = 0; ///< of the body in the text
  };
  [[nodiscard]] std::optional<List> list(const std::string& name) const {
    const auto found = after_define(name);
    if (!found || !found->starts_with('(')) return std::nullopt;
    const std::size_t comma = found->find(','), end = found->find(')');
    if (end == std::string_view::npos || comma > end) return std::nullopt;
    const std::string_view body = found->substr(end + 1);
    return List{{std::string(trimmed(found->substr(1, comma - 1))),
                 std::string(trimmed(found->substr(comma + 1, end - comma - 1)))},
                std::string(body),
                static_cast<std::size_t>(body.data() - text_.data())};
  }

  [[noreturn]] void fail(std::size_t at, const std::string& wrong, const std::string& right) const {
    const auto until = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at, text_.size()));
    const auto line = 1 + std::count_if(text_.begin(), until, [](char c) { return c == '\n' || c == '\f'; });
    throw SceneError(fmt::format("{}:{}: {}: {}", file_, line, wrong, right));
  }

private:
  static constexpr const char* blanks = " \t\f";
  static std::string_view trimmed(std::string_view words) {
    const std::size_t begin = std::min(words.find_first_not_of(blanks), words.size());
    return words.substr(begin, words.find_last_not_of(blanks) + 1 - begin);
  }
  // The rest of the next line after "#define NAME", after the one that returned `earlier`; nothing if no line
  // begins with that. Without regular expressions, which took a fifth of the time of a start.
  [[nodiscard]] std::optional<std::string_view> after_define(const std::string& name,
                                                             std::string_view earlier = {}) const {
    const std::string_view text = text_;
    const std::size_t first =
        earlier.data() == nullptr ? 0 : static_cast<std::size_t>(earlier.data() - text.data());
    for (std::size_t at = text.find(name, first); at != std::string_view::npos;
         at = text.find(name, at + 1)) {
      const std::size_t line = text.rfind('\n', at) + 1;
      std::string_view before = text.substr(line, at - line);
      const bool apart = !before.empty() && trimmed(before.substr(before.size() - 1)).empty();
      before = trimmed(before);
      const bool defines = apart && before.starts_with('#') && trimmed(before.substr(1)) == "define";
      const std::string_view rest = text.substr(at + name.size(), text.find('\n', at) - at - name.size());
      const bool whole =
          rest.empty() || (std::isalnum(static_cast<unsigned char>(rest[0])) == 0 && rest[0] != '_');
      if (defines && whole) return rest;
    }
    return std::nullopt;
  }

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
  static const std::regex blank_or_comment("[\\s\f]*(//.*)?");
  if (!std::regex_match(list.body.substr(end), blank_or_comment))
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
    static const std::regex member(R"((\w+)\s*\(\s*\w+\s*\))");
    model.derived_words = static_cast<int>(
        std::distance(std::sregex_iterator(derived->body.begin(), derived->body.end(), member), {}));
  }
  model.has_delta = defines.is_one(prefix + "_HAS_DELTA");
  model.transmits = defines.is_one(prefix + "_TRANSMITS");
  model.needs_tangents = defines.is_one(prefix + "_NEEDS_TANGENTS");
  model.reflectivity_is_estimate = defines.is_one(prefix + "_REFLECTIVITY_IS_ESTIMATE");
  model.has_survival = defines.has(prefix + "_SURVIVAL");
  model.has_textured = defines.has(prefix + "_TEXTURED");
  return model;
}

} // namespace phlux::lobes
