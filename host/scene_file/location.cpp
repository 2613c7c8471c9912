#include "scene_file/location.h"

#include <utility>

#include <spdlog/spdlog.h>

#include "printable.h"

namespace phlux::scene_file {

namespace {

/// For one line of a terminal, without the end of very long quotations of a file.
std::string shown(const std::string& text) {
  constexpr std::size_t longest = 1000;
  return printable(text.size() <= longest ? text : text.substr(0, longest) + "...");
}

} // namespace

LocatedError::LocatedError(Location at, const std::string& what_is_wrong, const std::string& what_is_right)
    : SceneError(printable(at.text()) + ": " + shown(what_is_wrong) + ": " + shown(what_is_right)),
      where(std::move(at)), wrong(shown(what_is_wrong)), right(shown(what_is_right)) {}

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
