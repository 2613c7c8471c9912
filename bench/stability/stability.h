// Measures every method on one scene over a grid of lobe exponents and light sizes: where its variance is
// suspect, and which method is the best.
#pragma once

#include <string>
#include <vector>

#include "bench/common/methods/comparison.h"

namespace phlux::bench {

/// A cell of the grid.
struct StabilityCell {
  double exponent = 0;     ///< >= 0
  double light_radius = 0; ///< above 0, at most largest_light_radius
  bool operator==(const StabilityCell&) const = default;
};

/// Default of seconds, per cell: 20, or 10 if quick. Default of side: 48, or 32 if quick.
struct StabilityOptions : ComparisonOptions {
  std::vector<StabilityCell> cells;  ///< empty: stability_cells()
  std::vector<std::string> variants; ///< of stability_method_names(); empty: all
};

/// The default grid: 36 cells, or nine of them if quick.
[[nodiscard]] std::vector<StabilityCell> stability_cells(bool quick);

/// "path none", "path light", ...: methods without their strategy.
[[nodiscard]] std::vector<std::string> stability_method_names();

/// Writes stability.csv (bench/README.md), a row per cell and method, and the references, then charts and the
/// report. Keeps the rows that an earlier run with the same settings left in the folder; resumes an
/// interrupted run at its cell. Returns false if interrupted. @throws UsageError, DeviceError, WriteError
[[nodiscard]] bool measure_stability(const StabilityOptions& options);

} // namespace phlux::bench
