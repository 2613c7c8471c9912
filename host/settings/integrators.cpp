#include "settings/integrators.h"

#include "settings/values.h"

namespace phlux::settings {

const IntegratorInfo& integrator_named(const std::string& name) {
  return integrators[choice(quoted("integrator"), name, integrator_names())];
}

const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const IntegratorInfo& info : integrators) list.emplace_back(info.name);
    return list;
  }();
  return names;
}

} // namespace phlux::settings
