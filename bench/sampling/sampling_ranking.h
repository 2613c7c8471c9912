// Ranks the strategies by variance x cost, the time to a given error (Veach 1997, chapter 2), with intervals.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/common/tables/saved_table.h"

namespace phlux::bench {

/// One strategy's estimator of one integral.
struct Competitor {
  std::string strategy;
  std::string marks; ///< Marks::text(): if not empty, the strategy is not compared
  double variance = 0, variance_standard_error = 0; ///< of one sample, over the square of the integral
  double cost = 0, cost_standard_error = 0;         ///< ns per sample: the sampler and the rays traced on
  /// By ranked(): variance x cost over that of the best, and the ends of the interval of this ratio. Infinite
  /// if the best is constant() and this one is not; the ratio of the costs if both are.
  double factor = 1, least = 1, most = 1;

  [[nodiscard]] bool compared() const { return marks.empty(); }
  /// Best, or not distinguished from the best: its interval reaches 1.
  [[nodiscard]] bool wins() const { return compared() && least <= 1; }
  /// Without variance, up to float32 rounding.
  [[nodiscard]] bool constant() const;
};

/// Sorts by variance x cost and sets factor, least and most. Those that are not compared come last. The
/// intervals hold together with probability 95%: the level of each is Sidak's for that many comparisons with
/// the best. The logarithm of variance x cost is taken as normally distributed.
[[nodiscard]] std::vector<Competitor> ranked(std::vector<Competitor> competitors);

/// The ranked estimators of one integral, all with or all without roulette.
struct Ranking {
  std::string one;   ///< "kd,ks,n,theta_deg"
  std::string light; ///< one of light_names()
  bool roulette = false;
  std::vector<Competitor> competitors;

  [[nodiscard]] std::vector<Competitor> winners() const; ///< the best first
};

/// The default cost of a ray, in ns: 20 samples by lobe-ks (the median over its rows; without it, over all
/// rows), which is about what a ray through half a million triangles takes (bench/PERFORMANCE.md).
[[nodiscard]] double default_ray_cost(const SavedTable& table);

/// A ranking for every integral of the tables without roulette, then for every one with roulette.
[[nodiscard]] std::vector<Ranking> rankings_of(const std::vector<SavedTable>& tables, double ray_ns);

struct WinCount {
  int best = 0, tied = 0; ///< number of rankings in which a strategy is the only winner, or one of several
  double slowest = 1;     ///< largest factor over the best
};

/// For each strategy, over the rankings of this condition in which it is compared.
[[nodiscard]] std::map<std::string, WinCount> count_wins(const std::vector<Ranking>& rankings, bool roulette);

/// Writes `folder`/`name`, a row per competitor (bench/README.md). @throws WriteError
void write_rankings(const std::filesystem::path& folder, const std::string& name,
                    const std::vector<Ranking>& rankings, double ray_ns);

} // namespace phlux::bench
