// What the checks mean, and where to look when one fails.
#pragma once

#include <string>

#include "verify/report.h"

namespace phlux::verify {

/// Which part of the program a result checks.
enum class Kind { model, strategy, integrator, lobe };
[[nodiscard]] Kind kind_of(const Result& result);

/// What the figure of a check is, in words, such as "f_r against float64, relative"; empty for an unknown
/// check.
[[nodiscard]] std::string meaning_of(const Result& result);

/// The kernel function to look at if the check fails, with its file, such as "phong_sample
/// (kernels/phong/one_part.cl)". Empty where the note names it (models of kernels/lobes) or none is
/// concerned.
[[nodiscard]] std::string function_to_look_at(const Result& result);

} // namespace phlux::verify
