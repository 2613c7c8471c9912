// The strategies that sample directions of the modified Phong model (kernels/phong/strategies).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "settings/values.h"

namespace phlux::settings {

struct Strategy {
  const char* name; ///< in options, messages and files; kernels/phong/strategies/NAME.cl
  bool biased = false;
};

/// In the order of the help.
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

/// Whether `strategy` is a user's kernel file, FILE.cl (kernels/phong/phong.cl: what it defines), not a name.
[[nodiscard]] bool is_strategy_file(const std::string& strategy);
/// `text` if it is the name of a strategy or of a kernel file, whose existence is not checked.
/// @throws UsageError "`NAME` TEXT: what would be right"
[[nodiscard]] std::string strategy(const std::string& name, const std::string& text);
/// The text of a user's file. @throws UsageError when it cannot be read, FileError when it lacks a function
[[nodiscard]] std::string read_strategy(const std::string& file);

} // namespace phlux::settings
