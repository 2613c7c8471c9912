// The strategies by which directions are sampled (MATH.md 2.3).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "settings/values.h"

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

[[nodiscard]] inline const std::vector<std::string>& strategy_names() {
  static const std::vector<std::string> names = names_in(strategies);
  return names;
}
/// @throws UsageError where there is none of that name
[[nodiscard]] inline const Strategy& strategy_named(const std::string& name) {
  return strategies[choice(quoted("strategy"), name, strategy_names())];
}

/// Whether it is a kernel file of the user's, FILE.cl, and no name (kernels/phong/phong.cl says what it
/// defines).
[[nodiscard]] bool is_strategy_file(const std::string& strategy);
/// `text` where it is the name of a strategy or of a kernel file, which may be missing yet.
/// @throws UsageError "`NAME` TEXT: what would be right"
[[nodiscard]] std::string strategy(const std::string& name, const std::string& text);
/// The text of a user's file. @throws UsageError when it cannot be read
[[nodiscard]] std::string read_strategy(const std::string& file);

} // namespace phlux::settings
