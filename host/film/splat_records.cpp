#include "film/splat_records.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/scene_data.h"

namespace phlux::film {
namespace {

constexpr std::int32_t none = -1; // replaces the pixel of a record that was added to another one

// The records, written about 50 ms ago, are no longer in the caches, and their arrays are too short for the
// hardware's prefetching.
constexpr std::size_t words_per_line = 16;
void fetch(const SplatRecords& records, std::size_t i) {
  if (i >= records.capacity) return;
  for (std::size_t array = 0; array < RECORD_VALUE + 3; ++array)
    __builtin_prefetch(records.words + array * records.capacity + i);
}

std::size_t path_of(const SplatRecords& records, std::size_t i) {
  return std::bit_cast<std::uint32_t>(records.words[RECORD_PATH * records.capacity + i]);
}

// A hash of the pixel to one of 64 bits: a path that has not set it has no record of that pixel.
std::uint64_t bit_of(std::int32_t pixel) {
  return std::uint64_t{1} << (static_cast<std::uint32_t>(pixel) * 0x9E3779B1u >> 26);
}

} // namespace

// Adds each record to an earlier one of the same path and pixel, if there is one. Most paths have two or
// three records, rarely two of the same pixel.
void SplatFolder::merge(const SplatRecords& records) {
  auto* const pixels = reinterpret_cast<std::int32_t*>(records.words + RECORD_PIXEL * records.capacity);
  const auto* const paths =
      reinterpret_cast<const std::int32_t*>(records.words + RECORD_PATH * records.capacity);
  paths_.assign(records.paths, {});
  earlier_.resize(std::max(earlier_.size(), records.count));
  for (std::size_t i = 0; i < records.count; ++i) {
    if (i % words_per_line == 0) fetch(records, i + 10 * words_per_line);
    if (pixels[i] == none) continue;
    PathSoFar& path = paths_[static_cast<std::size_t>(paths[i])];
    const std::uint64_t bit = bit_of(pixels[i]);
    std::int32_t same = (path.pixels & bit) != 0 ? path.last : -1;
    while (same >= 0 && pixels[same] != pixels[i]) same = earlier_[static_cast<std::size_t>(same)];
    if (same < 0) {
      path.pixels |= bit;
      earlier_[i] = path.last;
      path.last = static_cast<std::int32_t>(i);
      continue;
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
      float* const values = records.words + (RECORD_VALUE + channel) * records.capacity;
      values[same] += values[i];
    }
    pixels[i] = none;
  }
}

std::vector<std::size_t> SplatFolder::fold(const SplatRecords& records, Film& film) {
  std::vector<std::size_t> not_finite;
  const auto* const pixels =
      reinterpret_cast<const std::int32_t*>(records.words + RECORD_PIXEL * records.capacity);
  const float* const red = records.words + RECORD_VALUE * records.capacity;
  const float *const green = red + records.capacity, *const blue = green + records.capacity;
  constexpr std::size_t ahead = 16; // about the latency of memory
  for (std::size_t i = 0; i < records.count; ++i) {
    if (i + ahead < records.count && pixels[i + ahead] != none)
      film.expect_splat(static_cast<std::size_t>(pixels[i + ahead]));
    if (pixels[i] == none) continue;
    if (std::isfinite(red[i] + green[i] + blue[i]))
      film.add_splat(static_cast<std::size_t>(pixels[i]), {red[i], green[i], blue[i]},
                     i % Film::sized_one_in == 0);
    else
      not_finite.push_back(path_of(records, i));
  }
  return not_finite;
}

void SplatFolder::fold_techniques(const SplatRecords& records, Film& film) {
  const auto integers = [&](std::size_t array) {
    return reinterpret_cast<std::int32_t*>(records.words + array * records.capacity);
  };
  const auto reals = [&](std::size_t array) { return records.words + array * records.capacity; };
  std::int32_t* const pixels = integers(RECORD_PIXEL);
  for (std::size_t i = 0; i < records.count; ++i) {
    const std::int32_t tag = integers(RECORD_TECHNIQUE)[i];
    const bool own = tag < 0;
    const std::int32_t technique = own ? ~tag : tag;
    const float weight = reals(RECORD_WEIGHT)[i];
    std::array<double, 3> value;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      float& word = reals(RECORD_VALUE + channel)[i];
      value[channel] = word;
      word *= weight;
    }
    if (!std::isfinite(value[0] + value[1] + value[2])) continue;
    film.techniques()->add({technique >> 16, technique & 0xffff}, static_cast<std::size_t>(pixels[i]), value,
                           weight);
    if (own || value == std::array<double, 3>{}) pixels[i] = none;
  }
}

} // namespace phlux::film
