#include "files/contributions.h"

#include <set>

#include <catch2/catch.hpp>

#include "errors.h"
#include "files/tone_map.h"
#include "temporary_folder.h"

using namespace phlux::files;

namespace {

// Whether this text is drawn there: drawing it again changes nothing.
bool has_text(const Canvas& canvas, int left, int top, const char* text, int scale) {
  Canvas again = canvas;
  again.text(left, top, text, ink, scale);
  const int width = Canvas::text_width(text, scale), height = Canvas::text_height(scale);
  int drawn = 0;
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x)
      drawn += canvas.pixels()[static_cast<std::size_t>(y * canvas.width() + x)] == ink ? 1 : 0;
  return drawn > 0 && again.pixels() == canvas.pixels();
}

} // namespace

TEST_CASE("The contact sheet has (s,t) above the contributions of each technique, on both sides") {
  constexpr int side = 64, scale = 2, gap = 6, line = 9 * scale + scale, column = side + gap;
  phlux::film::Film film(side, side);
  film.use_splats();
  film.use_techniques();
  film.add_splatting_paths(side * side);
  const std::array<double, 3> light = {0.5, 0.5, 0.5};
  for (std::size_t pixel = 0; pixel < side * side; ++pixel) {
    film.techniques()->add({0, 3}, pixel, light, 0.5);
    film.techniques()->add({2, 1}, pixel, light, 0.5);
  }
  const Canvas sheet = contact_sheet(film);
  const int top = line + 2 * gap + line + side + gap, half = 3 * column + gap; // the row of two edges
  REQUIRE(sheet.width() == 2 * half + gap);
  REQUIRE(sheet.height() == top + line + side + gap);
  CHECK(has_text(sheet, gap, gap, "weighted", scale));
  CHECK(has_text(sheet, gap + half, gap, "unweighted", scale));
  for (const int left : {gap, gap + half}) {
    CHECK(has_text(sheet, left, top, "(0,3)", scale));
    CHECK(has_text(sheet, left + 2 * column, top, "(2,1)", scale));
    CHECK_FALSE(has_text(sheet, left + column, top, "(1,2)", scale)); // contributes nothing
  }
  const auto code_at = [&](int x, int y) {
    return sheet.pixels()[static_cast<std::size_t>(y * sheet.width() + x)].red;
  };
  const int inside = top + line + 1;
  CHECK(code_at(gap + 1, inside) < code_at(gap + half + 1, inside)); // half the light, with one exposure
}

TEST_CASE(
    "The files of contributions are known before there are any, and those of an earlier call are removed") {
  const TemporaryFolder place;
  const std::filesystem::path folder = place / "new";
  for (const char* name : {"s1-t2.exr", "s0-t12-unweighted.exr", "contributions.png"})
    CHECK(is_contribution(folder, folder / name));
  CHECK_FALSE(is_contribution(folder, folder / "image.exr"));
  CHECK_FALSE(is_contribution(folder, place / "s1-t2.exr"));
  check_contributions_writable(folder);
  place.write("new/s9-t9.exr", "of another render");
  place.write("new/notes.txt", "mine");
  phlux::film::Film film(2, 1);
  film.use_splats();
  film.use_techniques();
  film.add_splatting_paths(2);
  film.techniques()->add({1, 2}, 0, {1, 1, 1}, 0.5);
  write_contributions(folder, film, {});
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  CHECK(names ==
        std::set<std::string>{"s1-t2.exr", "s1-t2-unweighted.exr", "contributions.png", "notes.txt"});
  place.write("file", "");
  CHECK_THROWS_AS(check_contributions_writable(place / "file"), phlux::WriteError);
}
