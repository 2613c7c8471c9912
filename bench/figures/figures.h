// The figures of CW 197 (Lafortune and Willems 1994), computed by the kernels and drawn by matplotlib.
#pragma once

#include <cstdint>

#include "bench/common/options.h"

namespace phlux::bench {

struct FiguresOptions : CommonOptions {
  std::uint32_t seed = 1;
};

/// The sums of figures 6 (sampled) and 7 (evaluated) over their squares, and the reflectivity in closed form.
/// The three must agree up to noise.
struct FigureSums {
  double sampled = 0, evaluated = 0, exact = 0;
};

/// Computes the data of all figures and writes the tables. @throws DeviceError, WriteError
FigureSums write_figure_tables(const FiguresOptions& options);

/// Writes the tables, the figures as SVG and PNG, and the report. @throws DeviceError; WriteError, also if
/// the figures cannot be drawn, when the tables are complete
void make_figures(const FiguresOptions& options);

} // namespace phlux::bench
