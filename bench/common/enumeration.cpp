#include "bench/common/enumeration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace phlux::bench {

std::string enumeration(std::vector<std::string> words) {
  if (words.size() < 2) return words.empty() ? "" : words.front();
  const std::string last = words.back();
  words.pop_back();
  return fmt::format("{} and {}", fmt::join(words, ", "), last);
}

} // namespace phlux::bench
