#include "scene_file/parameters.h"

#include <string_view>
#include <vector>

#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

std::string names_of(const std::map<std::string, std::string>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names.empty() ? "none" : join(names);
}

} // namespace

void Parameters::set_default(const std::string& name, const std::string& value) {
  values_.emplace(name, value);
  used_.insert(name);
}

std::string Parameters::substitute(const std::string& text, const Location& where) {
  std::string result;
  std::string_view rest = text;
  while (true) {
    const auto dollar = rest.find('$');
    result += rest.substr(0, dollar);
    if (dollar == std::string_view::npos) return result;
    rest.remove_prefix(dollar + 1);
    const std::pair<const std::string, std::string>* longest = nullptr;
    for (const auto& entry : values_)
      if (rest.starts_with(entry.first) && (!longest || entry.first.size() > longest->first.size()))
        longest = &entry;
    any_unknown_ |= longest == nullptr;
    if (!longest)
      fail(where, "unknown parameter in '" + text + "'",
           "parameters are given by -D name=value or by an earlier <default>; known here: " +
               names_of(values_));
    result += longest->second;
    used_.insert(longest->first);
    rest.remove_prefix(longest->first.size());
  }
}

void Parameters::check_all_used(const Location& file) const {
  std::map<std::string, std::string> known = values_;
  for (const auto& [name, value] : defined_)
    if (!used_.contains(name)) known.erase(name);
  for (const auto& [name, value] : defined_)
    if (!used_.contains(name))
      fail(file, "-D " + name + "=" + value + " is used nowhere in the scene",
           "its parameters are " + names_of(known));
}

} // namespace phlux::scene_file
