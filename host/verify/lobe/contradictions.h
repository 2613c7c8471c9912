// Conclusions from a model's failed checks: which of its functions contradict each other.
#pragma once

#include <string>
#include <vector>

#include "verify/report.h"

namespace phlux::verify {

/// Sets the notes of the failed results of `name` in a judged report, and returns conclusions from them
/// together. `model` is the prefix of the functions.
[[nodiscard]] std::vector<std::string> explain(Report& report, const std::string& name,
                                               const std::string& model);

} // namespace phlux::verify
