// A fixed-width font of printable ASCII, for legends in pictures.
#pragma once

#include <string>
#include <string_view>

namespace phlux::files {

/// Pixels of a character: 7 rows above the base line, 2 below it.
inline constexpr int glyph_width = 5, glyph_height = 9;

/// Whether the pixel in column x and row y of the character is set; a character that is not printable ASCII
/// is a box.
[[nodiscard]] bool glyph_pixel(char character, int x, int y);

/// The text with one character (outside ASCII) for each of UTF-8's sequences.
[[nodiscard]] std::string glyphs_of(std::string_view text);

} // namespace phlux::files
