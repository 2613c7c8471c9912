#include "settings/strategies.h"

#include "settings/values.h"

namespace phlux::settings {

const Strategy& strategy_named(const std::string& name) {
  return strategies[choice(quoted("strategy"), name, strategy_names())];
}

const std::vector<std::string>& strategy_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Strategy& strategy : strategies) list.emplace_back(strategy.name);
    return list;
  }();
  return names;
}

} // namespace phlux::settings
