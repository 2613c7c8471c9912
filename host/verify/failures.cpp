#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files/output.h"
#include "files/png.h"
#include "verify/verify.h"

namespace phlux::verify {
namespace {

std::string stem_of(const Result& result) {
  std::string stem =
      fmt::format("verify-{}-{}", result.strategy.empty() ? "model" : result.strategy, result.check);
  for (const char c : {' ', '/'}) std::ranges::replace(stem, c, '-');
  return stem;
}

std::string csv_of(const Histogram& histogram) {
  std::string text = fmt::format("{}\n", fmt::join(histogram.columns, ","));
  for (const auto& row : histogram.rows) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

// The drawn columns as grey squares side by side, with one scale; y upwards.
files::Image picture_of(const Histogram& histogram) {
  constexpr std::size_t zoom = 8;
  const std::size_t side = histogram.side, width = side * histogram.drawn.size();
  files::Image image;
  image.width = static_cast<int>(width * zoom);
  image.height = static_cast<int>(side * zoom);
  std::vector<float> pixels(width * zoom * side * zoom);
  for (std::size_t y = 0; y < side * zoom; ++y)
    for (std::size_t x = 0; x < width * zoom; ++x) {
      const std::size_t row = (side - 1 - y / zoom) * side + x / zoom % side;
      const double value = histogram.rows[row][histogram.drawn[x / zoom / side]];
      pixels[y * width * zoom + x] = static_cast<float>(std::max(0.0, value));
    }
  for (const char* channel : {"R", "G", "B"}) image.channels[channel] = pixels;
  return image;
}

} // namespace

void write_failures(Report& report) {
  for (Result& result : report.results()) {
    const Histogram& histogram = result.histogram;
    if (result.passed || histogram.rows.empty()) continue;
    result.files.push_back(stem_of(result) + ".csv");
    files::write_file(result.files.back(), csv_of(histogram));
    if (histogram.side == 0) continue;
    result.files.push_back(stem_of(result) + ".png");
    files::write_png(result.files.back(), picture_of(histogram));
  }
}

} // namespace phlux::verify
