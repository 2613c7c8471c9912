// What may surprise in a valid scene, said once for each kind: thousands of objects may share it.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene_file/location.h"

namespace phlux::scene_file {

class Warnings {
public:
  Warnings() = default;
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  ~Warnings() { log(); } ///< also of a scene that is refused

  /// Warnings of one kind become one; without a kind, those of equal text.
  void add(const Location& where, const std::string& text, const std::string& kind = "");
  /// "NUMBER WHAT", with the sum of the numbers of all places.
  void add_number(const Location& where, std::size_t number, const std::string& what);
  /// Logs each kind once, with its first place and the number of places, and each other place as a note. Then
  /// forgets all of them.
  void log();

private:
  struct Kind {
    Location first;
    std::string text;
    std::size_t number = 0; ///< the sum of add_number(); 0: the text is complete
    std::set<std::pair<std::string, int>> places;
  };
  Kind& kind_of(const Location& where, const std::string& text, const std::string& name);

  std::vector<Kind> kinds_; ///< in the order of their first places
  std::map<std::string, std::size_t> index_;
  std::vector<std::pair<Location, std::string>> others_;
};

} // namespace phlux::scene_file
