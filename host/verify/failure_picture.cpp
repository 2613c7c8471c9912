#include "verify/failure_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "files/compare_picture.h"
#include "verify/meanings.h"

namespace phlux::verify {
namespace {

using files::Canvas;
using files::ink;
using files::paper;

// Sizes in pixels.
constexpr int text_scale = 2, line = 24; // of text
constexpr int zoom = 12;                 // side of a cell
constexpr int margin = 24, gap = 72, tick = 6;
constexpr int left_of_panels = 108; // room for the numbers of the y axis

class Picture {
public:
  explicit Picture(const Result& result)
      : histogram_(result.histogram), side_(static_cast<int>(histogram_.side)),
        panels_(static_cast<int>(histogram_.drawn.size()) + 1),
        canvas_(left_of_panels + panels_ * column_width(), top_of_panels + panel() + 6 * line + margin,
                paper) {
    write(
        margin, margin,
        fmt::format("{}, {}: {}, p {:.2g}", result.strategy, result.check, meaning_of(result), result.worst));
    write(margin, margin + line, result.where);
    draw_values();
    draw_difference();
    for (int i = 0; i < panels_; ++i) draw_axes(i);
  }

  [[nodiscard]] const Canvas& canvas() const { return canvas_; }

private:
  static constexpr int top_of_panels = margin + 4 * line;
  [[nodiscard]] int panel() const { return side_ * zoom; }
  [[nodiscard]] int column_width() const { return panel() + gap; }
  [[nodiscard]] int left_of(int column) const { return left_of_panels + column * column_width(); }

  void write(int left, int top, const std::string& text) { canvas_.text(left, top, text, ink, text_scale); }
  void write_centred(int middle, int top, const std::string& text) {
    write(middle - Canvas::text_width(text, text_scale) / 2, top, text);
  }

  // A value for each cell, by colours from -1 to 1.
  template<class Value>
  void draw_panel(int column, const std::string& title, const Value& value) {
    write(left_of(column), top_of_panels - line, title);
    canvas_.fill(left_of(column) - 1, top_of_panels - 1, panel() + 2, panel() + 2, ink); // the frame
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x)
        canvas_.fill(left_of(column) + x * zoom, top_of_panels + (side_ - 1 - y) * zoom, zoom, zoom,
                     files::false_color(value(histogram_.rows[static_cast<std::size_t>(y * side_ + x)])));
  }

  // The colours of [from, 1], of which 1 is `end`, below so many panels from `column` on.
  void draw_scale(int column, int columns, double from, double end, const std::string& meaning) {
    const int left = left_of(column), width = columns * column_width() - gap;
    const int top = top_of_panels + panel() + 3 * line;
    for (int x = 0; x < width; ++x)
      canvas_.fill(left + x, top, 1, line, files::false_color(from + (1 - from) * (x + 0.5) / width));
    write(left, top + line + 2 * text_scale, fmt::format("{:.2g}", from * end));
    if (from < 0) write_centred(left + width / 2, top + line + 2 * text_scale, "0");
    const std::string last = fmt::format("{:.2g}", end);
    write(left + width - Canvas::text_width(last, text_scale), top + line + 2 * text_scale, last);
    write_centred(left + width / 2, top + 2 * line + 2 * text_scale, meaning);
  }

  void draw_values() {
    double largest = 0;
    for (const auto& row : histogram_.rows)
      for (const std::size_t column : histogram_.drawn) largest = std::max(largest, row[column]);
    for (int i = 0; i + 1 < panels_; ++i) {
      const std::size_t column = histogram_.drawn[static_cast<std::size_t>(i)];
      draw_panel(i, histogram_.columns[column], [&](const std::vector<double>& row) {
        return largest > 0 ? row[column] / largest : row[column];
      });
    }
    draw_scale(0, panels_ - 1, 0, largest, histogram_.quantity);
  }

  void draw_difference() {
    const std::size_t seen = histogram_.drawn.front(), expected = histogram_.drawn.back();
    double largest = 0;
    for (const auto& row : histogram_.rows) largest = std::max(largest, std::abs(row[seen] - row[expected]));
    const std::string difference =
        fmt::format("{} - {}", histogram_.columns[seen], histogram_.columns[expected]);
    draw_panel(panels_ - 1, difference, [&](const std::vector<double>& row) {
      const double off = row[seen] - row[expected];
      return largest > 0 ? off / largest : off;
    });
    draw_scale(panels_ - 1, 1, -1, largest, difference);
  }

  // Ticks at the middles of the first, the middle and the last cells, whose coordinates are the first two
  // columns.
  void draw_axes(int column) {
    const int left = left_of(column), bottom = top_of_panels + panel();
    for (const int cell : {0, side_ / 2, side_ - 1}) {
      const int middle = cell * zoom + zoom / 2;
      const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * side_ + x); };
      canvas_.fill(left + middle, bottom, 2, tick, ink);
      write_centred(left + middle, bottom + tick + text_scale,
                    fmt::format("{:.2g}", histogram_.rows[at(cell, 0)][0]));
      canvas_.fill(left - tick, bottom - middle, tick, 2, ink);
      const std::string y = fmt::format("{:.2g}", histogram_.rows[at(0, cell)][1]);
      if (column == 0)
        write(left - tick - Canvas::text_width(y, text_scale),
              bottom - middle - Canvas::text_height(text_scale) / 2, y);
    }
    write_centred(left + panel() / 2, bottom + tick + line, histogram_.columns[0]);
    if (column == 0) write(margin, top_of_panels + panel() / 2 - 2 * line, histogram_.columns[1]);
  }

  const Histogram& histogram_;
  int side_, panels_;
  Canvas canvas_;
};

} // namespace

files::Canvas failure_picture(const Result& result) {
  return Picture(result).canvas();
}

} // namespace phlux::verify
