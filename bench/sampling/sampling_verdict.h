// The sentence with which `phlux bench sampling` ends: which strategy is the best, by what factor, and under
// which conditions.
#pragma once

#include <string>
#include <vector>

#include "bench/common/methods/ranking.h"
#include "bench/sampling/sampling_ranking.h"

namespace phlux::bench {

/// The conditions of a measurement that the sentence states.
struct VerdictConditions {
  double ray_ns = 0;  ///< cost of a ray
  std::string device; ///< its name, and WIDTH
  std::string option =
      "--strategy "; ///< before the name of the answer; empty for a model, which has no option
  CostClock clock = CostClock::processor;
};

/// A sentence on each case (all kinds of light), without roulette and then with it; the answer comes first,
/// in the spelling of the command line. Rankings of fewer than two competitors are passed over.
[[nodiscard]] std::vector<std::string> verdicts_on_cases(const std::vector<Ranking>& rankings,
                                                         const VerdictConditions& conditions);

/// One sentence on all: how often each strategy is the best, and how often it is tied. Empty if no ranking
/// has two competitors.
[[nodiscard]] std::string verdict_on_grid(const std::vector<Ranking>& rankings,
                                          const VerdictConditions& conditions);

} // namespace phlux::bench
