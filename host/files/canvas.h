// A picture of sRGB codes that is drawn: rectangles, text, pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/font.h"

namespace phlux::files {

struct Color {
  std::uint8_t red = 0, green = 0, blue = 0; ///< sRGB codes
  bool operator==(const Color&) const = default;
};

inline constexpr Color paper = {246, 246, 246}, ink = {24, 24, 24}; ///< background and text of pictures

/// Coordinates are pixels from the top left corner; what lies outside is not drawn.
class Canvas {
public:
  Canvas(int width, int height, Color background);

  void fill(int left, int top, int width, int height, Color color);

  /// Draws a line of text whose box begins at (left, top); each pixel of the font is `scale` pixels wide and
  /// high.
  void text(int left, int top, std::string_view text, Color color, int scale);

  [[nodiscard]] static int text_width(std::string_view text, int scale);
  [[nodiscard]] static int text_height(int scale) { return glyph_height * scale; }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const std::vector<Color>& pixels() const { return pixels_; } ///< row by row from the top

private:
  int width_, height_;
  std::vector<Color> pixels_;
};

} // namespace phlux::files
