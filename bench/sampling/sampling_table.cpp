#include "bench/sampling/sampling_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/tables/csv.h"
#include "measure/moments.h"

namespace phlux::bench {
namespace {

// Probabilities below are too small for a bias or a divergence ever to be measured.
constexpr double least_share = 1e-10;
constexpr double most_relative_error = 1.0 / 3;
constexpr double most_sigmas = 4;
constexpr double least_lobe_samples = 32;
// Relative error of a mean, by float32 and the table of reflectivities.
constexpr double arithmetic_error = 1e-5;

// Expected number of samples in the lobe, for strategies that ignore the lobe: solid angle of the lobe,
// 2 pi / (n + 1), times the density on its axis.
double lobe_samples(const SamplingRow& row) {
  const auto count = static_cast<double>(row.run.sums.count);
  if (has_roulette(row.strategy) || row.subject.one.given) return count;
  const double angle = row.subject.one.degrees * std::numbers::pi / 180, n = row.subject.one.exponent;
  const double width = 1 / std::sqrt(n + 1), solid_angle = 2 * std::numbers::pi / (n + 1);
  double density = 1 / (2 * std::numbers::pi);
  if (row.strategy == "theta-phi")
    density = 1 / (std::numbers::pi * std::numbers::pi * std::max(width, std::sin(angle)));
  if (row.strategy == "cosine" || row.strategy == "disk")
    density = std::max(width, std::cos(angle)) / std::numbers::pi;
  return count * density * solid_angle;
}

} // namespace

const std::vector<std::string>& sampling_columns() {
  static const std::vector<std::string> columns = {"strategy",
                                                   "kd",
                                                   "ks",
                                                   "n",
                                                   "theta_deg",
                                                   "samples",
                                                   "mean",
                                                   "exact",
                                                   "bias_sigma",
                                                   "variance",
                                                   "variance_standard_error",
                                                   "rays_per_sample",
                                                   "ns_per_sample",
                                                   "variance_times_cost",
                                                   "variance_times_rays",
                                                   "draws_per_sample",
                                                   "roulette",
                                                   "defects",
                                                   "ns_least",
                                                   "ns_most",
                                                   "seed",
                                                   "device",
                                                   "width",
                                                   "ns_wall",
                                                   "rounds",
                                                   "sample_variance",
                                                   "marks",
                                                   "integrand"};
  return columns;
}

std::string Marks::text() const {
  std::vector<std::string> words;
  if (biased) words.emplace_back("biased");
  if (diverges) words.emplace_back("infinite-variance-suspected");
  if (unresolved) words.emplace_back("unresolved");
  if (off) words.emplace_back("mean-off");
  return fmt::format("{}", fmt::join(words, " "));
}

Marks marks_of(const SamplingRow& row) {
  const measure::Moments m = moments_of(row.run.sums);
  const double exact = row.subject.reflected;
  const bool far = !(std::abs(bias_in_sigmas(m, exact)) < most_sigmas) &&
                   !(std::abs(m.mean - exact) < arithmetic_error * exact);
  const bool constant = std::sqrt(m.variance) < float_rounding * exact;
  Marks marks;
  if (row.strategy == "lobe-estimate-printed") {
    marks.biased = printed_loss(row.subject.one) > least_share;
    marks.diverges = printed_density_at_horizon(row.subject.one) > least_share;
  }
  // Samples that all miss the light are constant too, but then their mean is far from the exact value.
  marks.unresolved = lobe_samples(row) < least_lobe_samples ||
                     (constant ? far : !(m.variance_standard_error <= most_relative_error * m.variance));
  marks.off = far && !marks.biased;
  return marks;
}

std::string case_text(const Case& one) {
  if (one.given) return fmt::format(",,,{}", one.degrees);
  return fmt::format("{},{},{},{}", one.diffuse, one.specular, one.exponent, one.degrees);
}

std::string case_of_row(const SavedTable& table, const SavedTable::Row& row) {
  return fmt::format("{},{},{},{}", table.value(row, "kd"), table.value(row, "ks"), table.value(row, "n"),
                     table.value(row, "theta_deg"));
}

RowsByIntegral rows_by_integral(const SavedTable& table) {
  RowsByIntegral rows;
  for (const SavedTable::Row& row : table.rows())
    rows[case_of_row(table, row) + "," + table.value(row, "integrand")].push_back(row);
  return rows;
}

std::string sampling_line(const SamplingRow& row, const std::string& device, int lanes) {
  const measure::Moments m = moments_of(row.run.sums);
  const Marks marks = marks_of(row);
  const auto per_sample = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(row.run.sums.count);
  };
  const double factor = marks.diverges ? std::numeric_limits<double>::quiet_NaN() : 1;
  const double variance = factor * m.variance, nanoseconds = measure::median(row.nanoseconds),
               rays = per_sample(row.run.rays);
  const auto [least, most] = std::ranges::minmax(row.nanoseconds);
  return fmt::format("{},{},{},{:.9g},{:.9g},{:.4g},{:.8g},{:.4g},{:.6g},{:.5g},{:.6g},{:.6g},{:.6g},{},{},{:"
                     ".5g},{:.5g},{},{},"
                     "{},{:.5g},{},{:.8g},{},{}",
                     row.strategy, case_text(row.subject.one), row.run.sums.count, m.mean,
                     row.subject.reflected, bias_in_sigmas(m, row.subject.reflected), variance,
                     factor * m.variance_standard_error, rays, nanoseconds, variance * nanoseconds,
                     variance * rays, per_sample(row.run.draws), row.subject.roulette ? 1 : 0,
                     row.run.defects, least, most, row.subject.seed.s[0], csv_value(device), lanes,
                     measure::median(row.wall_nanoseconds), row.nanoseconds.size(), m.variance, marks.text(),
                     light_names()[static_cast<std::size_t>(row.subject.light)]);
}

} // namespace phlux::bench
