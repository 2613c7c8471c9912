#include <cmath>

#include <fmt/format.h>

#include "cli/commands.h"
#include "files/compare.h"
#include "files/exr.h"
#include "files/json.h"

namespace phlux::cli {

int compare(const CompareOptions& options) {
  const std::string a = options.a.string(), b = options.b.string();
  const files::Comparison comparison =
      files::compare(files::read_exr(options.a), files::read_exr(options.b), a, b);
  const nlohmann::ordered_json json = files::to_json(comparison);
  if (options.json) {
    fmt::print("{}", files::json_text(json));
  } else {
    for (const auto& [name, value] : json.items())
      fmt::print("{:<16}{}\n", name, value.is_null() ? "undefined" : value.dump());
  }
  if (comparison.nonfinite == 0) return 0;
  fmt::print(stderr, "phlux: {} values of {} and {} are not finite: the figures leave their pixels out\n",
             comparison.nonfinite, a, b);
  return 1;
}

} // namespace phlux::cli
