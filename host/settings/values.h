// Parses values. A text that is not a valid value throws UsageError "NAME TEXT: what would be right".
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace phlux::settings {

/// A decimal number from `least` to `most`.
[[nodiscard]] std::uint64_t whole_number(const std::string& name, const std::string& text,
                                         std::uint64_t least, std::uint64_t most);
/// 1 or more, or -1 for unbounded.
[[nodiscard]] int depth(const std::string& name, const std::string& text);
/// A number from `least` to `most`.
[[nodiscard]] double number_within(const std::string& name, const std::string& text, double least,
                                   double most);
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28; ///< of an image
inline constexpr int longest_side = 32768; ///< pixels; an OpenEXR file has no lines of 2^31 bytes
[[nodiscard]] bool is_image_size(std::int64_t width, std::int64_t height);
/// "at most 32768 pixels along each side and 2^28 pixels in all"
[[nodiscard]] std::string image_sizes();
/// WIDTHxHEIGHT in pixels; is_image_size().
[[nodiscard]] std::array<int, 2> size(const std::string& name, const std::string& text);
/// X,Y,WIDTH,HEIGHT in pixels; is_image_size().
[[nodiscard]] scene::Window window(const std::string& name, const std::string& text);
/// NAME=VALUE; the value may be empty.
[[nodiscard]] std::pair<std::string, std::string> definition(const std::string& name,
                                                             const std::string& text);
/// The index of `text` in `names`; the error suggests the nearest one.
[[nodiscard]] std::size_t choice(const std::string& name, const std::string& text,
                                 const std::vector<std::string>& names);

/// "`NAME`", a setting's name in messages; see cli/spelling.h.
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

/// The nearest name within two edits and half of the length of `text`; else empty.
[[nodiscard]] std::string nearest(const std::string& text, const std::vector<std::string>& names);

} // namespace phlux::settings
