// Text to numbers, the same in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phlux::scene_file {

/// A finite number that single precision can hold: |x| <= FLT_MAX. Nothing may follow it; blanks around it
/// are allowed.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);
[[nodiscard]] std::optional<int> parse_integer(std::string_view text);

/// The pieces between commas and blanks, as Mitsuba splits lists.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text);

/// Every piece of `text` as a number; nothing if one is not.
[[nodiscard]] std::optional<std::vector<double>> parse_reals(std::string_view text);

/// fovAxis -> fov_axis: Mitsuba 0.x names in the spelling of 2.x and 3.x.
[[nodiscard]] std::string to_snake_case(std::string_view name);
/// fov_axis -> fovAxis
[[nodiscard]] std::string to_camel_case(std::string_view name);

[[nodiscard]] std::string to_lower(std::string_view text);

/// 'text' for messages about files that may hold anything: its first 32 bytes, those outside ASCII as ?
[[nodiscard]] std::string quoted(std::string_view text);

/// "a, b, c"
[[nodiscard]] std::string join(const std::vector<std::string>& words);

} // namespace phlux::scene_file
