// Lists in sentences.
#pragma once

#include <string>
#include <vector>

namespace phlux::bench {

/// "a", "a and b", "a, b and c"; empty without words.
[[nodiscard]] std::string enumeration(std::vector<std::string> words);

} // namespace phlux::bench
