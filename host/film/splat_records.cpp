#include "film/splat_records.h"

#include <bit>

#include "scene_data.h"

namespace phlux::film {

void SplatFolder::fold(const SplatRecords& records, Film& film) {
  const auto word = [&](int array, std::size_t i) {
    return records.words[static_cast<std::size_t>(array) * records.capacity + i];
  };
  entries_.clear();
  last_.assign(records.paths, -1);
  for (std::size_t i = 0; i < records.count; ++i) {
    const auto pixel = static_cast<std::size_t>(std::bit_cast<std::int32_t>(word(RECORD_PIXEL, i)));
    std::int32_t& last = last_[static_cast<std::size_t>(std::bit_cast<std::int32_t>(word(RECORD_PATH, i)))];
    std::int32_t same = last;
    while (same >= 0 && entries_[static_cast<std::size_t>(same)].pixel != pixel)
      same = entries_[static_cast<std::size_t>(same)].earlier;
    if (same < 0) {
      same = static_cast<std::int32_t>(entries_.size());
      entries_.push_back({pixel, {}, last});
      last = same;
    }
    std::array<double, 3>& value = entries_[static_cast<std::size_t>(same)].value;
    for (int channel = 0; channel < 3; ++channel)
      value[static_cast<std::size_t>(channel)] += static_cast<double>(word(RECORD_VALUE + channel, i));
  }
  for (const Entry& entry : entries_) film.add_splat(entry.pixel, entry.value);
}

} // namespace phlux::film
