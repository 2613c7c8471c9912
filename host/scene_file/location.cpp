#include "scene_file/location.h"

#include <spdlog/spdlog.h>

#include "errors.h"
#include "printable.h"

namespace phlux::scene_file {

std::string Location::text() const {
  return line > 0 ? *file + ":" + std::to_string(line) : *file;
}

void fail(const Location& where, const std::string& wrong, const std::string& right) {
  constexpr std::size_t longest = 1000; // of each part, which may quote the file
  const auto part = [](const std::string& text) {
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
  };
  throw SceneError(printable(where.text() + ": " + part(wrong) + ": " + part(right)));
}

void warn(const Location& where, const std::string& message) {
  spdlog::warn("{}: {}", where.text(), message);
}

void note(const Location& where, const std::string& message) {
  spdlog::info("{}: {}", where.text(), message);
}

} // namespace phlux::scene_file
