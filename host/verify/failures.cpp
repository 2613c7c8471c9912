#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files/output.h"
#include "files/png.h"
#include "verify/failure_picture.h"
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

} // namespace

void write_failures(Report& report) {
  for (Result& result : report.results()) {
    const Histogram& histogram = result.histogram;
    if (result.passed || histogram.rows.empty()) continue;
    result.files.push_back(stem_of(result) + ".csv");
    files::write_file(result.files.back(), csv_of(histogram));
    if (histogram.side == 0) continue;
    result.files.push_back(stem_of(result) + ".png");
    files::write_file(result.files.back(), files::encode_png(failure_picture(result)));
  }
}

} // namespace phlux::verify
