#include "settings/strategies.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "errors.h"
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
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file))
    throw UsageError(fmt::format("{} {}: cannot be read: must be an existing file, or one of {}",
                                 quoted("strategy"), file, joined(strategy_names())));
  return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace phlux::settings
