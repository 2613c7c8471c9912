#include "scene_file/location.h"

#include <utility>

#include <spdlog/spdlog.h>

namespace phlux::scene_file {

namespace {

/// One line: text from the file may have line ends.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return text;
}

} // namespace

LocatedError::LocatedError(Location at, std::string what_is_wrong, std::string what_is_right)
    : SceneError(one_line(at.text() + ": " + what_is_wrong + ": " + what_is_right)), where(std::move(at)),
      wrong(one_line(std::move(what_is_wrong))), right(one_line(std::move(what_is_right))) {}

std::string Location::text() const {
  return line > 0 ? *file + ":" + std::to_string(line) : *file;
}

void fail(const Location& where, const std::string& wrong, const std::string& right) {
  throw LocatedError(where, wrong, right);
}

void warn(const Location& where, const std::string& message) {
  spdlog::warn("{}: {}", where.text(), message);
}

void note(const Location& where, const std::string& message) {
  spdlog::info("{}: {}", where.text(), message);
}

} // namespace phlux::scene_file
