// What the failed checks of a model mean: which of its functions contradicts which.
#pragma once

#include <string>
#include <vector>

#include "verify/report.h"

namespace phlux::verify {

/// Sets the notes of the failed results of `name`, a judged report's, and returns what follows from them
/// together. `model` is the prefix of the functions.
[[nodiscard]] std::vector<std::string> explain(Report& report, const std::string& name,
                                               const std::string& model);

} // namespace phlux::verify
