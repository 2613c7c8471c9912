// The table that `phlux bench sampling` prints at its end.
#pragma once

#include <string>
#include <vector>

#include "bench/common/tables/saved_table.h"

namespace phlux::bench {

/// Prints a row per strategy over all cases of sampling.csv: number of rows, of marked rows and of rows with
/// defects; the largest bias in standard errors; the median of the time over that of lobe-ks; and in how many
/// cases the strategy has the least variance x time.
void print_sampling_summary(const std::vector<std::string>& strategies, const SavedTable& table);

} // namespace phlux::bench
