// The Python programs that the build put into this binary.
#pragma once

#include <string_view>

namespace phlux::bench {

/// bench/figures.py
[[nodiscard]] std::string_view figures_script();

} // namespace phlux::bench
