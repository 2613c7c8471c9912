#include "scene_file/values.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>

namespace phlux::scene_file {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

template<class Number>
std::optional<Number> parse_whole(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+') && !text.starts_with("+-"))
    text.remove_prefix(1); // from_chars takes no plus sign
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (stopped != end) return std::nullopt;
  if constexpr (std::is_same_v<Number, double>)
    if (error == std::errc::result_out_of_range)
      return std::strtod(std::string(text).c_str(), nullptr); // 0 for 1e-400, infinity for 1e400
  if (error != std::errc{}) return std::nullopt;
  return value;
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
char lower(char c) {
  return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
}
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
  return parse_whole<double>(text);
}

std::optional<double> parse_real(std::string_view text) {
  const auto value = parse_number(text);
  if (!value || !(std::abs(*value) <= std::numeric_limits<float>::max())) return std::nullopt;
  return value;
}

std::optional<int> parse_integer(std::string_view text) {
  return parse_whole<int>(text);
}

std::vector<std::string_view> split(std::string_view text) {
  constexpr std::string_view separators = ", \t\r\n";
  std::vector<std::string_view> pieces;
  for (auto begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
    const auto end = text.find_first_of(separators, begin);
    pieces.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return pieces;
}

std::optional<std::vector<double>> parse_reals(std::string_view text) {
  std::vector<double> values;
  for (const auto piece : split(text)) {
    const auto value = parse_real(piece);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::string to_snake_case(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (is_upper(c) && !result.empty()) result += '_';
    result += lower(c);
  }
  return result;
}

std::string to_camel_case(std::string_view name) {
  std::string result;
  bool raise = false;
  for (const char c : name) {
    if (c != '_') result += raise ? upper(c) : c;
    raise = c == '_';
  }
  return result;
}

std::string to_lower(std::string_view text) {
  std::string result;
  for (const char c : text) result += lower(c);
  return result;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t most = 32;
  std::string result = "'";
  for (const char c : text.substr(0, most)) result += c > ' ' && c < 127 ? c : '?';
  return result + (text.size() > most ? "...'" : "'");
}

std::string join(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& word : words) result += (result.empty() ? "" : ", ") + word;
  return result;
}

} // namespace phlux::scene_file
