// Positions in files, and errors, warnings and notes about them.
#pragma once

#include <memory>
#include <string>

#include "errors.h"

namespace phlux::scene_file {

struct Location {
  std::shared_ptr<const std::string> file;
  int line = 0;                           ///< from 1; 0: the file as a whole
  [[nodiscard]] std::string text() const; ///< FILE:LINE
};

/// An error at a position: "FILE:LINE: wrong: right".
struct LocatedError : SceneError {
  LocatedError(Location where, const std::string& wrong, const std::string& right);
  Location where;
  std::string wrong, right;
};

/// @throws LocatedError
[[noreturn]] void fail(const Location& where, const std::string& wrong, const std::string& right);

/// Logs something that may surprise, though the scene is valid.
void warn(const Location& where, const std::string& message);

/// Logs something that is ignored because it cannot change the image.
void note(const Location& where, const std::string& message);

} // namespace phlux::scene_file
