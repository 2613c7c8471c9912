#include "files/compare_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "files/compare.h"
#include "files/png.h"
#include "files/tone_map.h"

namespace phlux::files {
namespace {

constexpr Color not_finite = {0, 200, 0};
constexpr std::size_t outliers_one_in = 20;

// Sizes in pixels.
constexpr int least_side = 320;          // of a picture: smaller images are magnified, for the titles to fit
constexpr int least_text_scale = 2;      // of the font's pixels
constexpr int side_per_text_scale = 250; // larger images have larger text

constexpr const char* formula = "(A - B) / sqrt(B^2 + 1e-4)";

// Three columns, each with a title, a picture and room for a scale.
struct Layout {
  Layout(const Image& image, bool all_finite)
      : zoom(std::max(1, (least_side + std::max(image.width, image.height) - 1) /
                             std::max(image.width, image.height))),
        picture_width(image.width * zoom), picture_height(image.height * zoom),
        column_width(std::max(picture_width, least_side)),
        text_scale(std::max(least_text_scale, std::min(picture_width, picture_height) / side_per_text_scale)),
        line(Canvas::text_height(text_scale) + 2 * text_scale), lines_below(all_finite ? 4 : 5) {}

  int zoom, picture_width, picture_height, column_width, text_scale;
  int line;        // height of a line of text, and the margin
  int lines_below; // the pictures: the scale, its text and the margin
  [[nodiscard]] int left(int column) const { return line + column * (column_width + line); }
  [[nodiscard]] int top() const { return 2 * line; }                                // of the pictures
  [[nodiscard]] int scale_top() const { return top() + picture_height + line / 2; } // of the colour scale
  [[nodiscard]] int width() const { return left(3); }
  [[nodiscard]] int height() const { return scale_top() + lines_below * line; }
};

// The name, or its end, after "A: ".
std::string title(const std::string& letter, const std::string& name, const Layout& layout) {
  std::string shown = letter + ": " + name;
  for (std::size_t cut = 1; Canvas::text_width(shown, layout.text_scale) > layout.column_width; ++cut)
    shown = letter + ": ..." + name.substr(cut);
  return shown;
}

void draw_difference(Canvas& canvas, const Layout& layout, const std::vector<double>& differences,
                     double scale, int image_width) {
  for (std::size_t pixel = 0; pixel < differences.size(); ++pixel) {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(image_width)),
              y = static_cast<int>(pixel / static_cast<std::size_t>(image_width));
    canvas.fill(layout.left(2) + x * layout.zoom, layout.top() + y * layout.zoom, layout.zoom, layout.zoom,
                false_color(differences[pixel] / scale));
  }
}

// The scale's colours, its values and what they mean.
void draw_scale(Canvas& canvas, const Layout& layout, double scale, bool all_finite) {
  const int left = layout.left(2), width = layout.column_width, text_scale = layout.text_scale;
  for (int x = 0; x < width; ++x)
    canvas.fill(left + x, layout.scale_top(), 1, layout.line, false_color(2.0 * (x + 0.5) / width - 1.0));
  int top = layout.scale_top() + layout.line + 2 * text_scale;
  const auto write = [&](const std::string& text, int halves) { // of the way from left to right
    const int room = width - Canvas::text_width(text, text_scale);
    canvas.text(left + room * halves / 2, top, text, ink, text_scale);
  };
  write(fmt::format("{:g}%", -100.0 * scale), 0);
  write("0", 1);
  write(fmt::format("{:g}%", 100.0 * scale), 2);
  top += layout.line;
  write("A darker", 0);
  write("A brighter", 2);
  top += layout.line;
  if (!all_finite) write("green: not finite", 0);
}

} // namespace

std::vector<double> relative_differences(const Image& a, const Image& b) {
  std::vector<double> differences(a.channels.at("R").size());
  for (const char* name : radiance_names) {
    const std::vector<float>&of_a = a.channels.at(name), &of_b = b.channels.at(name);
    for (std::size_t pixel = 0; pixel < differences.size(); ++pixel) {
      const double value_a = of_a[pixel], value_b = of_b[pixel];
      const double difference = (value_a - value_b) / std::sqrt(value_b * value_b + relmse_offset);
      double& largest = differences[pixel];
      if (!std::isfinite(value_a) || !std::isfinite(value_b))
        largest = std::numeric_limits<double>::quiet_NaN();
      else if (std::abs(difference) > std::abs(largest)) // never where it is NaN
        largest = difference;
    }
  }
  return differences;
}

double scale_of(const std::vector<double>& differences) {
  std::vector<double> sizes;
  for (const double difference : differences)
    if (!std::isnan(difference) && difference != 0.0) sizes.push_back(std::abs(difference));
  if (sizes.empty()) return 0.01;
  const auto end = sizes.end() - 1 - static_cast<std::ptrdiff_t>(sizes.size() / outliers_one_in);
  std::nth_element(sizes.begin(), end, sizes.end());
  const double power = std::pow(10.0, std::floor(std::log10(*end)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (*end <= digit * power) return digit * power;
  return 10.0 * power;
}

Color false_color(double value) {
  if (std::isnan(value)) return not_finite;
  // sRGB codes at 0, 1/2 and 1; luminance falls with the magnitude.
  using Ramp = std::array<std::array<double, 3>, 3>;
  constexpr Ramp blues = {{{255, 255, 255}, {70, 140, 230}, {10, 20, 110}}},
                 reds = {{{255, 255, 255}, {240, 110, 70}, {110, 0, 20}}};
  const Ramp& ramp = value < 0.0 ? blues : reds;
  const double place = 2.0 * std::min(std::abs(value), 1.0);
  const std::size_t first = place < 1.0 ? 0 : 1;
  const auto code = [&](std::size_t channel) {
    const double share = place - static_cast<double>(first);
    return static_cast<std::uint8_t>(
        std::lround(ramp[first][channel] + share * (ramp[first + 1][channel] - ramp[first][channel])));
  };
  return {code(0), code(1), code(2)};
}

Canvas compare_picture(const Image& a, const Image& b, const std::string& name_a, const std::string& name_b) {
  const std::vector<double> differences = relative_differences(a, b);
  const bool all_finite = std::ranges::none_of(differences, [](double value) { return std::isnan(value); });
  const Layout layout(b, all_finite);
  Canvas canvas(layout.width(), layout.height(), paper);
  const auto begin_column = [&](int column, const std::string& text) {
    canvas.text(layout.left(column), layout.line / 2 + layout.text_scale, text, ink, layout.text_scale);
    canvas.fill(layout.left(column) - 1, layout.top() - 1, layout.picture_width + 2,
                layout.picture_height + 2, ink); // the frame
  };
  const float exposed = exposure(b);
  begin_column(0, title("A", name_a, layout));
  draw_image(canvas, layout.left(0), layout.top(), layout.zoom, a, exposed);
  begin_column(1, title("B", name_b, layout));
  draw_image(canvas, layout.left(1), layout.top(), layout.zoom, b, exposed);
  begin_column(2, formula);
  const double scale = scale_of(differences);
  draw_difference(canvas, layout, differences, scale, b.width);
  draw_scale(canvas, layout, scale, all_finite);
  return canvas;
}

} // namespace phlux::files
