#include "render/programs.h"

namespace phlux::render {

device::BuiltProgram Programs::program(const Parts& parts, const std::function<void()>& slow) {
  constexpr std::size_t most = 16;
  std::map<std::string, std::string> key = parts.defines();
  key["file"] = parts.file();
  if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
  if (kept_.size() == most) kept_.clear();
  return kept_.emplace(key, device::build(device_, files_, parts.source(parts.file()), slow)).first->second;
}

} // namespace phlux::render
