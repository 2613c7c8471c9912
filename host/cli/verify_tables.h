// Tables, explanations and failures that `phlux verify` prints.
#pragma once

#include "verify/report.h"

namespace phlux::cli {

/// Tables of the worst figure of each check: of strategies, models and integrators.
void print_results(const verify::Report& report);
/// The definition of each figure in the tables.
void print_meanings(const verify::Report& report);
/// Notes, then each failure with the kernel function to look at.
void print_failures(const verify::Report& report);

} // namespace phlux::cli
