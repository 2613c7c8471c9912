#include "settings/setting.h"

#include <fmt/format.h>

namespace phlux::settings {

std::string text_of(const Value& value) {
  return std::visit(
      [](const auto& of) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(of)>, std::monostate>)
          return {};
        else
          return fmt::format("{}", of);
      },
      value);
}

} // namespace phlux::settings
