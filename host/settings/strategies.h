// The strategies by which directions are sampled (MATH.md 2.3).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace phlux::settings {

struct Strategy {
  const char* name; ///< of options, messages and files; kernels/phong/strategies/NAME.cl
  bool biased = false;
};

/// In the order in which help lists them.
inline constexpr std::array<Strategy, 12> strategies = {{
    {"uniform"},
    {"theta-phi"},
    {"cosine"},
    {"disk"},
    {"rejection"},
    {"lobe-ks"},
    {"lobe-estimate-printed", true},
    {"lobe-estimate"},
    {"lobe-rho"},
    {"mixture"},
    {"fold"},
    {"exact"},
}};

/// @throws UsageError where there is no strategy of that name
[[nodiscard]] const Strategy& strategy_named(const std::string& name);
[[nodiscard]] const std::vector<std::string>& strategy_names();

} // namespace phlux::settings
