// Texts to values. What is not a value throws UsageError "NAME TEXT: what would be right".
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace phlux::settings {

/// A decimal number from `least` to `most`.
[[nodiscard]] std::uint64_t whole_number(const std::string& name, const std::string& text,
                                         std::uint64_t least, std::uint64_t most);
/// 1 or more, or -1 for unbounded.
[[nodiscard]] int depth(const std::string& name, const std::string& text);
/// A finite number above 0.
[[nodiscard]] double positive_number(const std::string& name, const std::string& text);
/// A number from `least` to `most`.
[[nodiscard]] double number_within(const std::string& name, const std::string& text, double least,
                                   double most);
/// WIDTHxHEIGHT in pixels; at most 2^28 pixels, which take 15 GB.
[[nodiscard]] std::array<int, 2> size(const std::string& name, const std::string& text);
/// NAME=VALUE; the value may be empty.
[[nodiscard]] std::pair<std::string, std::string> definition(const std::string& name,
                                                             const std::string& text);
/// The index of `text` in `names`; the error names the nearest one, or all.
[[nodiscard]] std::size_t choice(const std::string& name, const std::string& text,
                                 const std::vector<std::string>& names);

/// "`NAME`", as messages below the command line name a setting.
[[nodiscard]] std::string quoted(const std::string& name);
/// "a, b, c"
[[nodiscard]] std::string joined(const std::vector<std::string>& names);

/// The members `name` of a table's entries.
template<class Table>
[[nodiscard]] std::vector<std::string> names_in(const Table& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  return names;
}

/// The name that `text` was probably meant to be: within two edits, and within half of its length; else
/// empty.
[[nodiscard]] std::string nearest(const std::string& text, const std::vector<std::string>& names);

} // namespace phlux::settings
