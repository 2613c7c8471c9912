// The table that `phlux bench sampling` prints at its end.
#pragma once

#include <string>
#include <vector>

#include "bench/common/tables/saved_table.h"
#include "bench/sampling/sampling_ranking.h"

namespace phlux::bench {

/// Prints a row per strategy over all cases of sampling.csv: number of rows, of marked rows and of rows with
/// defects; the largest bias in standard errors; the median of the time over that of lobe-ks; and in how many
/// rankings the strategy is the best + tied, without and with roulette.
void print_sampling_summary(const std::vector<std::string>& strategies, const SavedTable& table,
                            const std::vector<Ranking>& rankings);

} // namespace phlux::bench
