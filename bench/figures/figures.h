// The figures of CW 197 from the kernels' own output: computed on a device, written as tables, drawn by
// matplotlib.
#pragma once

#include <cstdint>

#include "bench/common/options.h"

namespace phlux::bench {

struct FiguresOptions : CommonOptions {
  std::uint32_t seed = 1;
};

/// What must agree: figures 6 and 7 summed over their squares, and the reflectivity in closed form.
struct FigureSums {
  double sampled = 0, evaluated = 0, exact = 0;
};

/// Computes every figure's data and writes the tables. @throws DeviceError, WriteError
FigureSums write_figure_tables(const FiguresOptions& options);

/// The tables, then SVG and PNG files beside them and the report. @throws DeviceError, WriteError, also when
/// the drawings cannot be made: the tables are there then
void make_figures(const FiguresOptions& options);

} // namespace phlux::bench
