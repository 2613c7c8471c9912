#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "errors.h"
#include "files/compare.h"
#include "files/compare_picture.h"
#include "files/exr.h"
#include "files/flip_page.h"
#include "files/json.h"
#include "files/output.h"
#include "files/png.h"
#include "printable.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

namespace fs = std::filesystem;

void check_outputs(const CompareOptions& options) {
  if (is_of_another_format(options.picture, ".png"))
    throw UsageError(fmt::format("--png {}: the picture is a PNG file, such as {}", options.picture.string(),
                                 fs::path(options.picture).replace_extension(".png").string()));
  std::vector<fs::path> outputs = {options.picture, options.page};
  std::erase(outputs, fs::path());
  reject_same_names(outputs);
  reject_inputs(outputs, {options.a, options.b});
  for (const fs::path& file : outputs) files::check_writable(file);
}

// Metrics that these images have.
std::vector<std::string> metrics_in(const nlohmann::ordered_json& json) {
  std::vector<std::string> names;
  std::ranges::copy_if(files::metric_names, std::back_inserter(names),
                       [&](const std::string& name) { return json.contains(name); });
  return names;
}

void require_metrics(const CompareOptions& options, const nlohmann::ordered_json& json) {
  for (const auto& [metric, value] : options.limits)
    if (!json.contains(metric))
      throw UsageError(fmt::format("--fail-above {}={}: {} and {} do not both have channels variance.R, .G "
                                   "and .B: render with --moments, or use one of {}",
                                   metric, value, options.a.string(), options.b.string(),
                                   fmt::join(metrics_in(json), ", ")));
}

std::string text_of(const nlohmann::ordered_json& value) {
  if (value.is_array()) {
    std::vector<std::string> texts;
    for (const nlohmann::ordered_json& element : value) texts.push_back(text_of(element));
    return fmt::format("{}", fmt::join(texts, " "));
  }
  if (!value.is_number_float() || std::isfinite(value.get<double>())) return value.dump();
  return std::isnan(value.get<double>()) ? "undefined" : "infinite";
}

// Prints those above. NaN is, whatever the limit.
bool any_above_limit(const CompareOptions& options, const nlohmann::ordered_json& json) {
  bool any = false;
  for (const auto& [metric, limit] : options.limits) {
    if (json[metric].get<double>() <= limit) continue;
    tell("phlux: {} is {}: must be at most {}\n", metric, text_of(json[metric]), limit);
    any = true;
  }
  return any;
}

// Prints what is left out.
bool too_many_not_finite(const CompareOptions& options, std::uint64_t count) {
  if (count == 0) return false;
  tell("phlux: {} values of {} and {} are not finite: their pixels are left out of the metrics\n", count,
       printable(options.a.string()), printable(options.b.string()));
  return std::ranges::find(options.limits, "nonfinite", &CompareOptions::Limit::metric) ==
         options.limits.end();
}

} // namespace

int compare(const CompareOptions& options) {
  const std::string a = options.a.string(), b = options.b.string();
  check_outputs(options);
  const files::Image image_a = files::read_exr(options.a), image_b = files::read_exr(options.b);
  warn_if_changed(image_a, a);
  warn_if_changed(image_b, b);
  const files::Comparison comparison = files::compare(image_a, image_b, a, b);
  const nlohmann::ordered_json json = files::to_json(comparison);
  require_metrics(options, json);
  if (!options.picture.empty())
    files::write_file(options.picture, files::encode_png(files::compare_picture(image_a, image_b, a, b)));
  if (!options.page.empty()) files::write_file(options.page, files::flip_page(image_a, image_b, a, b));
  if (options.json)
    say("{}", files::json_text(json));
  else
    for (const auto& [name, value] : json.items()) say("{:<16}{}\n", name, text_of(value));
  const bool unsound = too_many_not_finite(options, comparison.nonfinite);
  return any_above_limit(options, json) || unsound ? 1 : 0;
}

} // namespace phlux::cli
