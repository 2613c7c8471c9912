#include "settings/strategies.h"

#include <fmt/format.h>

#include "errors.h"
#include "input_file.h"
#include "settings/values.h"

namespace phlux::settings {

bool is_strategy_file(const std::string& strategy) {
  return strategy.ends_with(".cl");
}

std::string strategy(const std::string& name, const std::string& text) {
  if (is_strategy_file(text)) return text;
  return strategy_names()[choice(name, text, strategy_names())];
}

std::string read_strategy(const std::string& file) {
  const auto text = kernel_text_of(file);
  if (!text)
    throw UsageError(fmt::format("{} {}: cannot be read: must be an existing file, or one of {}",
                                 quoted("strategy"), file, joined(strategy_names())));
  // What a file includes may define them.
  for (const char* function : {"phong_density", "phong_sample", "phong_survival"})
    if (text->find(function) == std::string::npos && text->find("#include") == std::string::npos)
      throw FileError(
          fmt::format("{}: does not define {}: a strategy defines phong_density, phong_sample and "
                      "phong_survival, or includes phong/plain.cl, which does",
                      file, function));
  return *text;
}

} // namespace phlux::settings
