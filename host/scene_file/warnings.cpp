#include "scene_file/warnings.h"

#include <fmt/format.h>

namespace phlux::scene_file {

Warnings::Kind& Warnings::kind_of(const Location& where, const std::string& text, const std::string& name) {
  const auto [entry, is_new] = index_.emplace(name, kinds_.size());
  if (is_new) kinds_.push_back({where, text, 0, {}});
  Kind& kind = kinds_[entry->second];
  kind.places.emplace(*where.file, where.line);
  return kind;
}

void Warnings::add(const Location& where, const std::string& text, const std::string& kind) {
  const std::size_t known = kinds_.size();
  kind_of(where, text, kind.empty() ? text : kind);
  if (kinds_.size() == known) others_.emplace_back(where, text);
}

void Warnings::add_number(const Location& where, std::size_t number, const std::string& what) {
  if (number == 0) return;
  const std::size_t known = kinds_.size();
  kind_of(where, what, what).number += number;
  if (kinds_.size() == known) others_.emplace_back(where, fmt::format("{} {}", number, what));
}

void Warnings::log() {
  for (const Kind& kind : kinds_) {
    const std::string text = kind.number > 0 ? fmt::format("{} {}", kind.number, kind.text) : kind.text;
    const std::string places =
        kind.places.size() == 1 ? "" : fmt::format(" (the first of {} places)", kind.places.size());
    warn(kind.first, text + places);
  }
  for (const auto& [where, text] : others_) note(where, text);
  kinds_.clear();
  index_.clear();
  others_.clear();
}

} // namespace phlux::scene_file
