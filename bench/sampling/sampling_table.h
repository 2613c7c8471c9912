// Rows of `phlux bench sampling`: what is said of a strategy in a case, and what is not.
#pragma once

#include <string>
#include <vector>

#include "bench/sampling/sampler.h"

namespace phlux::bench {

/// What one row says.
struct SamplingRow {
  Subject subject;
  std::string strategy;
  Sampler::Run run;
  std::vector<double> nanoseconds, wall_nanoseconds; ///< per sample, of each round
};

/// The columns of the contract, then those that say how they were measured; the kind of light comes last.
[[nodiscard]] const std::vector<std::string>& sampling_columns();

/// What keeps a row from being compared with others.
struct Marks {
  bool biased = false;     ///< a known bias, of any size that could ever be seen
  bool diverges = false;   ///< the variance is infinite by what printed_density_at_horizon() says
  bool unresolved = false; ///< too few samples: the variance's standard error is above a third of it, or
                           ///< hardly one is expected where the lobe is
  bool off = false; ///< without a known bias, the mean is 4 standard errors or more from the exact value, and
                    ///< by more than the arithmetic explains

  [[nodiscard]] bool any() const { return biased || diverges || unresolved || off; }
  /// "biased infinite-variance-suspected unresolved mean-off", as many as there are.
  [[nodiscard]] std::string text() const;
};

[[nodiscard]] Marks marks_of(const SamplingRow& row);

/// One line under sampling_columns(). A variance that is suspected to be infinite is nan, and so are its
/// standard error and its products; sample_variance has what these samples happened to give.
[[nodiscard]] std::string sampling_line(const SamplingRow& row, const std::string& device, int lanes);

/// The values of kd, ks, n, theta_deg as they stand in the table.
[[nodiscard]] std::string case_text(const Case& one);

} // namespace phlux::bench
