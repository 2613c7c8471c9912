#include "files/compare_picture.h"

#include <cmath>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

#include "errors.h"
#include "files/png.h"
#include "files/tone_map.h"

using namespace phlux::files;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

Image grey(int width, int height, const std::vector<float>& values) {
  return {width, height, {{"R", values}, {"G", values}, {"B", values}}, {}};
}

// The pixels of a colour and the box around them.
struct Patch {
  int pixels = 0, left = std::numeric_limits<int>::max(), top = left, right = 0, bottom = 0;
};

Patch patch_of(const Canvas& canvas, Color color) {
  Patch patch;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      if (canvas.pixels()[static_cast<std::size_t>(y * canvas.width() + x)] == color) {
        ++patch.pixels;
        patch.left = std::min(patch.left, x);
        patch.top = std::min(patch.top, y);
        patch.right = std::max(patch.right, x + 1);
        patch.bottom = std::max(patch.bottom, y + 1);
      }
  return patch;
}

Color screen_color(float exposed) {
  const std::uint8_t code = srgb_code(exposed);
  return {code, code, code};
}

double luminance(Color color) {
  return 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
}

} // namespace

TEST_CASE("The difference of a pixel is that of the channel that differs most, with its sign") {
  Image a = grey(3, 1, {1.0F, 1.0F, 0.5F}), b = grey(3, 1, {1.0F, 0.0F, 0.5F});
  a.channels["G"] = {0.5F, 0.001F, not_a_number};
  a.channels["B"] = {1.2F, 0.0F, 4.0F};
  const std::vector<double> differences = relative_differences(a, b);
  CHECK(differences[0] == Approx(-0.5 / std::sqrt(1.0001)));
  CHECK(differences[1] == Approx(100.0)); // b is black
  CHECK(std::isnan(differences[2]));
}

TEST_CASE("The colour scale ends at the 95th percentile of the differences, rounded up") {
  CHECK(scale_of({0.0, 0.013, 0.0}) == Approx(0.02));
  CHECK(scale_of({-0.21}) == Approx(0.5));
  CHECK(scale_of({-51.0}) == Approx(100.0));
  CHECK(scale_of({1.0}) == Approx(1.0));
  CHECK(scale_of({0.0, not_a_number}) == Approx(0.01));
  std::vector<double> noise(100, 0.1);
  for (std::size_t i = 0; i < 5; ++i) noise[i] = -1000.0;
  CHECK(scale_of(noise) == Approx(0.1));
  noise[5] = 900.0;
  CHECK(scale_of(noise) == Approx(1000.0));
}

TEST_CASE("False colours tell the sign, and are darker for larger differences") {
  CHECK(false_color(0.0) == Color{255, 255, 255});
  for (double value = 0.0; value < 0.99; value += 0.05) {
    CHECK(luminance(false_color(value + 0.05)) < luminance(false_color(value)));
    CHECK(luminance(false_color(-value - 0.05)) < luminance(false_color(-value)));
    CHECK(false_color(value + 0.05).red > false_color(value + 0.05).blue);
    CHECK(false_color(-value - 0.05).red < false_color(-value - 0.05).blue);
  }
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(false_color(infinity) == false_color(1.0));
  CHECK(false_color(-infinity) == false_color(-1.0));
  CHECK(luminance(false_color(std::nan(""))) < luminance(false_color(0.0)));
}

TEST_CASE("The picture shows A, B and their difference side by side, with one exposure") {
  // The pixel on the top right of A is darker by 2/3 than B, that on the bottom left brighter by 2/3.
  const Image a = grey(2, 2, {3.0F, 1.0F, 5.0F, 3.0F}), b = grey(2, 2, {3.0F, 3.0F, 3.0F, 3.0F});
  const Canvas canvas = compare_picture(a, b, "a.exr", "b.exr");
  const Patch darker = patch_of(canvas, screen_color(0.06F)), brighter = patch_of(canvas, screen_color(0.3F)),
              middle = patch_of(canvas, screen_color(0.18F)), // two pixels of A, four of B
      below = patch_of(canvas, false_color(-2.0 / 3.0)), above = patch_of(canvas, false_color(2.0 / 3.0));
  const int side = darker.right - darker.left;
  CHECK(side > 100); // magnified
  CHECK(darker.pixels == side * side);
  CHECK(brighter.pixels == side * side);
  CHECK(middle.pixels == 6 * side * side);
  CHECK(darker.left == middle.left + side);
  CHECK(brighter.right == darker.left);
  CHECK(brighter.top == darker.bottom);
  CHECK(middle.right > brighter.right + 2 * side);
  CHECK(below.pixels >= side * side);
  CHECK(below.top == darker.top);
  CHECK(below.right == above.left + 2 * side);
  CHECK(below.left > middle.right);
}

TEST_CASE("Titles and the scale are drawn, and long names are cut at their beginning") {
  const Image b = grey(2, 2, {3.0F, 3.0F, 3.0F, not_a_number});
  const auto pixels_of = [&](const std::string& name) {
    return compare_picture(b, b, name, "b.exr").pixels();
  };
  CHECK(pixels_of("a.exr") != pixels_of("b.exr"));
  CHECK(pixels_of(std::string(300, 'x') + "a.exr") == pixels_of(std::string(200, 'x') + "a.exr"));
  CHECK(pixels_of(std::string(300, 'x') + "a.exr") != pixels_of(std::string(300, 'x') + "b.exr"));
  const Canvas canvas = compare_picture(b, b, "a", "b");
  CHECK(patch_of(canvas, false_color(std::nan(""))).pixels > 100);
}

TEST_CASE("Every character has a glyph of its own") {
  std::set<std::string> seen;
  for (int code = ' '; code < 128; ++code) {
    std::string glyph;
    for (int y = 0; y < glyph_height; ++y)
      for (int x = 0; x < glyph_width; ++x) glyph += glyph_pixel(static_cast<char>(code), x, y) ? '#' : ' ';
    seen.insert(glyph);
    CHECK((glyph.find('#') == std::string::npos) == (code == ' '));
  }
  CHECK(seen.size() == 96);
  CHECK(glyph_pixel('\n', 0, 0));                                               // the box
  CHECK(Canvas::text_width("Gr\xc3\xbcn", 2) == Canvas::text_width("Grun", 2)); // UTF-8
}

TEST_CASE("What lies outside a canvas is not drawn") {
  Canvas canvas(4, 3, {1, 2, 3});
  canvas.fill(-5, 1, 6, 1, {9, 9, 9});
  canvas.fill(3, -1, 100, 2, {9, 9, 9});
  canvas.fill(4, 0, 1, 3, {9, 9, 9});
  canvas.text(-100, -100, "outside", {9, 9, 9}, 1);
  CHECK(patch_of(canvas, {9, 9, 9}).pixels == 2);
  CHECK(canvas.pixels()[3] == Color{9, 9, 9});
  CHECK(canvas.pixels()[4] == Color{9, 9, 9});
}
