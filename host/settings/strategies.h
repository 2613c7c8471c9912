// The strategies by which directions are sampled (MATH.md 2.3).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace phlux::settings {

struct Strategy {
  const char* name;  ///< of options, messages and files
  const char* macro; ///< its number in the kernels (lobes/phong.cl)
  bool biased = false;
};

/// In the order in which help lists them.
inline constexpr std::array<Strategy, 12> strategies = {{
    {"uniform", "STRATEGY_UNIFORM"},
    {"theta-phi", "STRATEGY_THETA_PHI"},
    {"cosine", "STRATEGY_COSINE"},
    {"disk", "STRATEGY_DISK"},
    {"rejection", "STRATEGY_REJECTION"},
    {"lobe-ks", "STRATEGY_LOBE_KS"},
    {"lobe-estimate-printed", "STRATEGY_LOBE_ESTIMATE_PRINTED", true},
    {"lobe-estimate", "STRATEGY_LOBE_ESTIMATE"},
    {"lobe-rho", "STRATEGY_LOBE_RHO"},
    {"mixture", "STRATEGY_MIXTURE"},
    {"fold", "STRATEGY_FOLD"},
    {"exact", "STRATEGY_EXACT"},
}};

/// @throws UsageError where there is no strategy of that name
[[nodiscard]] const Strategy& strategy_named(const std::string& name);
[[nodiscard]] const std::vector<std::string>& strategy_names();

} // namespace phlux::settings
