// Rows of sampling.csv and sampling-no-roulette.csv, and the marks on rows that must not be compared.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/common/tables/saved_table.h"
#include "bench/sampling/sampler.h"

namespace phlux::bench {

/// The measurement of one row.
struct SamplingRow {
  Subject subject;
  std::string strategy;
  Sampler::Run run;
  std::vector<double> nanoseconds, wall_nanoseconds; ///< per sample, of each round
};

/// Relative standard deviation that float32 rounding gives a constant estimate.
inline constexpr double float_rounding = 1e-6;

/// The fixed columns, then those about the measurement; the last one is the kind of light.
[[nodiscard]] const std::vector<std::string>& sampling_columns();

/// Reasons why a row must not be compared with others.
struct Marks {
  bool biased = false;     ///< known bias, if large enough ever to be measured
  bool diverges = false;   ///< infinite variance, by printed_density_at_horizon()
  bool unresolved = false; ///< too few samples: relative standard error of the variance above a third, or
                           ///< too few samples expected in the lobe
  bool off = false; ///< without a known bias, the mean differs from the exact value by 4 standard errors or
                    ///< more, and by more than rounding explains

  [[nodiscard]] bool any() const { return biased || diverges || unresolved || off; }
  /// Those that apply, of "biased infinite-variance-suspected unresolved mean-off".
  [[nodiscard]] std::string text() const;
};

[[nodiscard]] Marks marks_of(const SamplingRow& row);

/// The row as text. A variance that is suspected to be infinite is nan, and so are its standard error and its
/// products; sample_variance is then the variance of these samples.
[[nodiscard]] std::string sampling_line(const SamplingRow& row, const std::string& device, int lanes);

/// The columns kd, ks, n, theta_deg as text; the first three are empty for a material of another model.
[[nodiscard]] std::string case_text(const Case& one);

/// The same of a row of a saved table.
[[nodiscard]] std::string case_of_row(const SavedTable& table, const SavedTable::Row& row);

/// The rows of a saved table by the text of case and light: "kd,ks,n,theta_deg,integrand".
using RowsByIntegral = std::map<std::string, std::vector<SavedTable::Row>>;
[[nodiscard]] RowsByIntegral rows_by_integral(const SavedTable& table);

} // namespace phlux::bench
