// The atlas: every method over the exponent of a lobe and the size of a light, on one scene with both as
// parameters; where its variance is suspect, and which method is the best.
#pragma once

#include <string>
#include <vector>

#include "bench/common/methods/comparison.h"

namespace phlux::bench {

/// A place on the map.
struct StabilityCell {
  double exponent = 0;     ///< >= 0
  double light_radius = 0; ///< above 0, at most largest_light_radius
  bool operator==(const StabilityCell&) const = default;
};

/// Seconds are a cell's; absent: 20, or 10 when quick, which takes nine cells. Absent side: 48, or 32.
struct StabilityOptions : ComparisonOptions {
  std::vector<StabilityCell> cells;  ///< empty: stability_cells()
  std::vector<std::string> variants; ///< names of methods with the default strategy; empty: all
};

/// The grid that is measured where no cells are named.
[[nodiscard]] std::vector<StabilityCell> stability_cells(bool quick);

/// "path none", "path light", ...: what `variants` may name.
[[nodiscard]] std::vector<std::string> stability_method_names();

/// Writes stability.csv (README.md), a row for each cell and method, cell by cell, and the references, then
/// charts and the report. Rows that the folder has of the same settings are kept, so that an interrupted run
/// goes on at the cell where it was stopped. Returns false when interrupted. @throws UsageError, DeviceError,
/// WriteError
[[nodiscard]] bool measure_stability(const StabilityOptions& options);

} // namespace phlux::bench
