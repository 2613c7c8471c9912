// All that is wrong with a scene file, for one error that names everything.
#pragma once

#include <string>
#include <vector>

#include "scene_file/location.h"

namespace phlux::scene_file {

class Problems {
public:
  void add(const LocatedError& error);
  /// Calls `read` and adds the error that it throws, so that the rest of the file is read as well.
  template<class Read>
  void attempt(Read read) {
    try {
      read();
    } catch (const LocatedError& error) {
      add(error);
    }
  }
  /// @throws SceneError "FILE:LINE: wrong, line N: wrong: right; line N: ...", in the order of lines; what is
  /// right is said once for all errors that share it
  void throw_if_any() const;

private:
  std::vector<LocatedError> errors_;
};

} // namespace phlux::scene_file
