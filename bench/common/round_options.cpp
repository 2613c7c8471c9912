#include "bench/common/round_options.h"

#include <fmt/format.h>

namespace phlux::bench {

std::string RoundOptions::command(const std::string& name, const std::string& more) const {
  std::string text = "phlux bench " + name;
  if (quick) text += " --quick";
  for (const auto& scene : scenes) text += " --scene " + scene.string();
  text += more;
  if (samples > 0) text += fmt::format(" --samples {}", samples);
  return fmt::format("{} --seed {}", text, seed);
}

std::string RoundOptions::seeds(int count) const {
  return fmt::format("{} to {}", seed, seed + static_cast<std::uint64_t>(count - 1));
}

std::string text_of_values(const char* option, const std::vector<std::string>& values,
                           const std::vector<std::string>& defaults) {
  std::string text;
  if (values != defaults)
    for (const std::string& value : values) text += fmt::format(" {} {}", option, value);
  return text;
}

} // namespace phlux::bench
