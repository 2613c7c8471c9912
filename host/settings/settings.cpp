#include "settings/settings.h"

#include <algorithm>

#include "errors.h"

namespace phlux::settings {

const std::vector<Setting>& all() {
  static const std::vector<Setting> list = declared_settings();
  return list;
}

const Setting& named(const std::string& name) {
  const auto found = std::ranges::find(all(), name, &Setting::name);
  if (found == all().end()) throw UsageError(quoted(name) + ": there is no such setting");
  return *found;
}

std::map<std::string, std::string> texts_of(const Settings& settings,
                                            const std::function<bool(Affects)>& wanted) {
  std::map<std::string, std::string> texts;
  for (const Setting& setting : all())
    if (const std::string text = setting.text(settings); wanted(setting.affects) && !text.empty())
      texts.emplace(setting.name, text);
  return texts;
}

} // namespace phlux::settings
