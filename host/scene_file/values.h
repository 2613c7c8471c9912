// Parsing of numbers, independent of the locale, and text helpers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phlux::scene_file {

/// A number, rounded to double; also inf and nan. Only blanks are allowed around it.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// A finite number in the range of single precision, |x| <= FLT_MAX. Only blanks are allowed around it.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);
[[nodiscard]] std::optional<int> parse_integer(std::string_view text);

/// The pieces between commas and blanks, as Mitsuba splits lists.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text);

/// All pieces of `text` as numbers; nothing if one is not a number.
[[nodiscard]] std::optional<std::vector<double>> parse_reals(std::string_view text);

/// fovAxis -> fov_axis: names of Mitsuba 0.x in the spelling of 2.x and 3.x.
[[nodiscard]] std::string to_snake_case(std::string_view name);
/// fov_axis -> fovAxis
[[nodiscard]] std::string to_camel_case(std::string_view name);

[[nodiscard]] std::string to_lower(std::string_view text);

/// 'text' for messages: its first 32 bytes, with ? for those that are not printable ASCII
[[nodiscard]] std::string quoted(std::string_view text);

/// "a, b, c"
[[nodiscard]] std::string join(const std::vector<std::string>& words);

} // namespace phlux::scene_file
