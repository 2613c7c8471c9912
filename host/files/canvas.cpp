#include "files/canvas.h"

#include <algorithm>

namespace phlux::files {
namespace {

constexpr int advance = glyph_width + 1; // from a character to the next

} // namespace

Canvas::Canvas(int width, int height, Color background)
    : width_(width), height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

void Canvas::fill(int left, int top, int width, int height, Color color) {
  const int right = std::min(left + width, width_), bottom = std::min(top + height, height_);
  left = std::max(left, 0);
  for (int y = std::max(top, 0); y < bottom && left < right; ++y) {
    const auto row = pixels_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    std::fill(row + left, row + right, color);
  }
}

void Canvas::text(int left, int top, std::string_view text, Color color, int scale) {
  for (const char character : glyphs_of(text)) {
    for (int row = 0; row < glyph_height; ++row)
      for (int column = 0; column < glyph_width; ++column)
        if (glyph_pixel(character, column, row))
          fill(left + column * scale, top + row * scale, scale, scale, color);
    left += advance * scale;
  }
}

int Canvas::text_width(std::string_view text, int scale) {
  return static_cast<int>(glyphs_of(text).size()) * advance * scale;
}

} // namespace phlux::files
