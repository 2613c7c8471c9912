#include "scene_file/location.h"

#include <spdlog/spdlog.h>

#include "errors.h"

namespace phlux::scene_file {

std::string Location::text() const {
  return line > 0 ? *file + ":" + std::to_string(line) : *file;
}

void fail(const Location& where, const std::string& wrong, const std::string& right) {
  std::string line = where.text() + ": " + wrong + ": " + right;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ') c = '?'; // text from the file may have line ends
  throw SceneError(line);
}

void warn(const Location& where, const std::string& message) {
  spdlog::warn("{}: {}", where.text(), message);
}

void note(const Location& where, const std::string& message) {
  spdlog::info("{}: {}", where.text(), message);
}

} // namespace phlux::scene_file
