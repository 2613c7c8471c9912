#include "scene_file/problems.h"

#include <algorithm>
#include <tuple>

#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

/// More would not help, and would take time to compare.
constexpr std::size_t most_errors = 1000;

/// "FILE:LINE" for the first error and other files, "line N" for the file of the error before.
class Places {
public:
  std::string operator()(const Location& where) {
    const bool same_file = *where.file == file_ && where.line > 0;
    file_ = *where.file;
    return same_file ? "line " + std::to_string(where.line) : where.text();
  }

private:
  std::string file_;
};

using Errors = std::vector<LocatedError>;

/// "PLACE: wrong (again on lines 5, 9)" for errors that differ in their line alone.
std::string text_of_equal(const Errors& equal, Places& places) {
  std::vector<std::string> lines;
  for (const LocatedError& error : equal)
    if (&error != &equal.front()) lines.push_back(std::to_string(error.where.line));
  const std::string again = lines.empty()       ? ""
                            : lines.size() == 1 ? " (again on line " + lines.front() + ")"
                                                : " (again on lines " + join(lines) + ")";
  return places(equal.front().where) + ": " + equal.front().wrong + again;
}

/// The first group whose member matches `error`, or a new one.
template<class Same>
Errors& group_of(std::vector<Errors>& groups, const LocatedError& error, Same same) {
  const auto found =
      std::ranges::find_if(groups, [&](const Errors& group) { return same(group.front(), error); });
  return found == groups.end() ? groups.emplace_back() : *found;
}

} // namespace

void Problems::add(const LocatedError& error) {
  const bool is_known = std::ranges::any_of(errors_, [&](const LocatedError& other) {
    return other.where.line == error.where.line && other.wrong == error.wrong &&
           *other.where.file == *error.where.file;
  });
  if (!is_known && errors_.size() < most_errors) errors_.push_back(error);
}

void Problems::throw_if_any() const {
  if (errors_.empty()) return;
  Errors sorted = errors_;
  std::ranges::stable_sort(
      sorted, {}, [](const LocatedError& error) { return std::tie(*error.where.file, error.where.line); });
  std::vector<Errors> by_remedy;
  for (const LocatedError& error : sorted)
    group_of(by_remedy, error, [](const auto& a, const auto& b) {
      return a.right == b.right;
    }).push_back(error);
  Places places;
  std::string text;
  for (const Errors& group : by_remedy) {
    std::vector<Errors> by_wrong;
    for (const LocatedError& error : group)
      group_of(by_wrong, error, [](const auto& a, const auto& b) {
        return a.wrong == b.wrong && *a.where.file == *b.where.file;
      }).push_back(error);
    std::vector<std::string> wrongs;
    for (const Errors& equal : by_wrong) wrongs.push_back(text_of_equal(equal, places));
    text += (text.empty() ? "" : "; ") + join(wrongs) + ": " + group.front().right;
  }
  throw SceneError(text);
}

} // namespace phlux::scene_file
