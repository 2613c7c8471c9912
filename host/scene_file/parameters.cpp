#include "scene_file/parameters.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

template<class Values>
std::string names_of(const Values& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names.empty() ? "none" : join(names);
}

} // namespace

void Parameters::set_default(const std::string& name, const std::string& value, const Location& where) {
  if (name.size() > longest_name)
    fail(where, "a <default> with a name of " + std::to_string(name.size()) + " characters",
         "at most " + std::to_string(longest_name));
  values_.emplace(name, value);
  used_.insert(name);
}

// Of the known names that `text` begins with, the longest. In the order of texts it is the last that is not
// after `text`, or, if that one only shares some letters with it, the same for these letters.
const Parameters::Values::value_type* Parameters::longest_match(std::string_view text) const {
  while (true) {
    const auto after = values_.upper_bound(text);
    if (after == values_.begin()) return nullptr;
    const auto& entry = *std::prev(after);
    if (text.starts_with(entry.first)) return &entry;
    text =
        text.substr(0, static_cast<std::size_t>(std::ranges::mismatch(text, entry.first).in1 - text.begin()));
  }
}

std::string Parameters::substitute(const std::string& text, const Location& where) {
  std::string result;
  std::string_view rest = text;
  while (true) {
    const auto dollar = rest.find('$');
    result += rest.substr(0, dollar);
    if (dollar == std::string_view::npos) return result;
    rest.remove_prefix(dollar + 1);
    const auto* longest = longest_match(rest);
    any_unknown_ |= longest == nullptr;
    if (!longest)
      fail(where, "unknown parameter in '" + text + "'",
           "parameters are given by `D` NAME=VALUE or by an earlier <default>; known here: " +
               names_of(values_));
    if (result.size() + longest->second.size() > longest_text)
      fail(where, "'" + text + "' is longer than " + std::to_string(longest_text) + " characters",
           "parameters that do not repeat each other");
    result += longest->second;
    if ((substituted_ += longest->second.size()) > most_substituted)
      fail(where,
           "more than " + std::to_string(most_substituted) + " characters are substituted for parameters",
           "shorter parameters");
    used_.insert(longest->first);
    rest.remove_prefix(longest->first.size());
  }
}

void Parameters::check_all_used(const Location& file) const {
  Values known = values_;
  for (const auto& [name, value] : defined_)
    if (!used_.contains(name)) known.erase(name);
  for (const auto& [name, value] : defined_)
    if (!used_.contains(name))
      fail(file, "`D` " + name + "=" + value + " is used nowhere in the scene",
           "its parameters are " + names_of(known));
}

} // namespace phlux::scene_file
