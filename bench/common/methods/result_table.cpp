#include "bench/common/methods/result_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/common/tables/csv.h"

namespace phlux::bench {
namespace {

using Values = ResultTable::Values;

Values all_columns(const Values& key_columns, const Values& columns) {
  Values all = key_columns;
  all.insert(all.end(), {"integrator", "strategy", "connect_or_weights"});
  all.insert(all.end(), columns.begin(), columns.end());
  all.emplace_back("settings");
  return all;
}

} // namespace

ResultTable::ResultTable(const std::filesystem::path& folder, const std::string& name,
                         const Values& key_columns, const Values& columns)
    : table_(folder, name, all_columns(key_columns, columns)), key_size_(key_columns.size()) {}

bool ResultTable::is_of(const SavedTable::Row& row, const Values& key) const {
  return std::equal(key.begin(), key.end(), row.begin());
}

Method ResultTable::method_of(const SavedTable::Row& row) const {
  return {row[key_size_], row[key_size_ + 1], row[key_size_ + 2]};
}

bool ResultTable::has(const Values& key, const std::vector<Method>& methods,
                      const std::string& settings) const {
  return std::ranges::all_of(methods, [&](const Method& method) {
    return std::ranges::any_of(table_.rows(), [&](const SavedTable::Row& row) {
      return is_of(row, key) && method_of(row) == method && row.back() == settings;
    });
  });
}

std::vector<Method> ResultTable::with_earlier(const Values& key, std::vector<Method> methods,
                                              const std::string& settings) const {
  for (const SavedTable::Row& row : table_.rows())
    if (is_of(row, key) && row.back() == settings && std::ranges::count(methods, method_of(row)) == 0)
      methods.push_back(method_of(row));
  return methods;
}

void ResultTable::remove(const Values& key) {
  table_.remove_if([&](const SavedTable::Row& row) { return is_of(row, key); });
}

void ResultTable::add(const Values& key, const Method& method, const Values& values,
                      const std::string& settings) {
  SavedTable::Row row = key;
  row.insert(row.end(), {method.integrator, method.strategy, method.variant});
  row.insert(row.end(), values.begin(), values.end());
  row.push_back(settings);
  table_.add(std::move(row));
}

const std::vector<std::string>& result_columns() {
  static const std::vector<std::string> columns = {"device",
                                                   "samples_per_pixel",
                                                   "seconds",
                                                   "relmse",
                                                   "variance_per_sample",
                                                   "variance_standard_error",
                                                   "top_share",
                                                   "seconds_per_sample",
                                                   "variance_times_seconds", // last fixed column
                                                   "verdict",
                                                   "reason",
                                                   "variance_measured",
                                                   "variance_measured_standard_error",
                                                   "seconds_per_sample_least",
                                                   "seconds_per_sample_most",
                                                   "processor_seconds_per_sample",
                                                   "processor_seconds_per_sample_least",
                                                   "processor_seconds_per_sample_most",
                                                   "clock",
                                                   "cost",
                                                   "cost_ratio",
                                                   "cost_ratio_low",
                                                   "cost_ratio_high",
                                                   "rank",
                                                   "mean",
                                                   "mean_standard_error",
                                                   "mean_bias_sigma",
                                                   "rounds",
                                                   "seed",
                                                   "image",
                                                   "reference_by",
                                                   "reference_relmse",
                                                   "reference_seconds",
                                                   "lanes"};
  return columns;
}

std::vector<std::string> result_values(const MethodResult& result, const RankedCost& cost,
                                       const ReferenceImage& reference, const scene::Camera& camera,
                                       const CommonValues& common) {
  Values row = {csv_value(common.device)};
  const bool refused = result.verdict == Verdict::refused, sound = result.verdict == Verdict::sound;
  const auto add = [&](double value, bool valid = true) {
    row.push_back(refused || !valid ? "" : number_text(value));
  };
  const ConvergencePoint end = refused ? ConvergencePoint{} : result.convergence.back();
  add(end.samples_per_pixel);
  add(end.seconds);
  add(end.relmse);
  const bool variance_known = result.verdict != Verdict::suspect_variance;
  add(result.variance.value, variance_known);
  add(result.variance.standard_error, variance_known);
  add(result.top_share);
  add(result.wall.median);
  add(result.variance.value * result.wall.median, sound);
  row.emplace_back(word_of(result.verdict));
  row.push_back(csv_value(result.reason));
  add(result.variance.value);
  add(result.variance.standard_error);
  add(result.wall.least);
  add(result.wall.most);
  for (const double value : {result.processor.median, result.processor.least, result.processor.most})
    add(value);
  row.emplace_back(word_of(common.clock));
  add(cost.cost);
  for (const double value : {cost.ratio, cost.low, cost.high}) add(value);
  row.emplace_back(word_of(cost.rank));
  add(result.mean.value);
  add(result.mean.standard_error);
  add(result.mean_bias_sigma);
  for (const std::string& text : {fmt::format("{}", result.rounds.size()), fmt::format("{}", common.seed),
                                  fmt::format("{}x{}", camera.width, camera.height),
                                  csv_value(reference.method), number_text(reference.image.relmse()),
                                  number_text(reference.seconds), fmt::format("{}", common.lanes)})
    row.push_back(text);
  return row;
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

} // namespace phlux::bench
