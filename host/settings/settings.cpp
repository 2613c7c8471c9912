#include "settings/settings.h"

#include <algorithm>

#include <fmt/format.h>

#include "errors.h"

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

Value Crop::value(const std::optional<scene::Window>& of) {
  return of ? Value(fmt::format("{},{},{},{}", of->x, of->y, of->width, of->height)) : Value();
}

const std::vector<Setting>& all() {
  static const std::vector<Setting> list = declared_settings();
  return list;
}

const Setting& named(std::string_view name) {
  const auto found = std::ranges::find(all(), name, &Setting::name);
  if (found == all().end()) throw UsageError(quoted(std::string(name)) + ": there is no such setting");
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
