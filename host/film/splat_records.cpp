#include "film/splat_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

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

std::int32_t* pixels_of(const SplatRecords& records) {
  return reinterpret_cast<std::int32_t*>(records.words + RECORD_PIXEL * records.capacity);
}

std::size_t path_of(const SplatRecords& records, std::size_t i) {
  return std::bit_cast<std::uint32_t>(records.words[RECORD_PATH * records.capacity + i]);
}

// A hash of the pixel to one of 64 bits: a path that has not set it has no record of that pixel.
std::uint64_t bit_of(std::int32_t pixel) {
  return std::uint64_t{1} << (static_cast<std::uint32_t>(pixel) * 0x9E3779B1u >> 26);
}

// Their pixels are prefetched: about the latency of memory.
constexpr std::size_t splats_ahead = 16;

// The arrays of merged records.
struct Words {
  explicit Words(const SplatRecords& records)
      : pixels(pixels_of(records)), red(records.words + RECORD_VALUE * records.capacity),
        green(red + records.capacity), blue(green + records.capacity) {}
  [[nodiscard]] bool is_finite(std::size_t i) const { return std::isfinite(red[i] + green[i] + blue[i]); }
  template<class Target> // a film or a part of it
  void add(std::size_t i, Target& to) const {
    to.add_splat(static_cast<std::size_t>(pixels[i]), {red[i], green[i], blue[i]},
                 i % Film::sized_one_in == 0);
  }
  const std::int32_t* pixels;
  const float *red, *green, *blue;
};

} // namespace

void DividedSplats::begin(std::span<const SplatRecords> batches, const Film& film, std::size_t parts) {
  batches_ = batches;
  rows_per_pixel_ = 1.0 / static_cast<double>(film.row_of_tiles());
  part_of_row_.resize(film.pixels().size() / film.row_of_tiles() + 1);
  for (std::size_t row = 0; row < part_of_row_.size(); ++row)
    part_of_row_[row] = static_cast<std::uint8_t>(Film::Part::of_row(row, parts));
  first_.clear();
  std::size_t records = 0;
  for (const SplatRecords& batch : batches) {
    first_.push_back(records);
    records += batch.count;
  }
  part_of_.resize(std::max(part_of_.size(), records));
}

std::vector<std::size_t> DividedSplats::divide(std::size_t batch) {
  const SplatRecords& records = batches_[batch];
  const Words words(records);
  std::uint8_t* const part_of = part_of_.data() + first_[batch];
  std::vector<std::size_t> not_finite;
  for (std::size_t i = 0; i < records.count; ++i) {
    part_of[i] = no_part;
    if (words.pixels[i] == none) continue;
    // Faster than an integer division; see TileMeans::tile_of().
    if (words.is_finite(i))
      part_of[i] = part_of_row_[static_cast<std::uint32_t>((words.pixels[i] + 0.5) * rows_per_pixel_)];
    else
      not_finite.push_back(path_of(records, i));
  }
  return not_finite;
}

void DividedSplats::add(std::size_t batch, std::size_t part, Film::Part& to) const {
  const SplatRecords& records = batches_[batch];
  const Words words(records);
  const std::uint8_t* const part_of = part_of_.data() + first_[batch];
  std::array<std::uint32_t, 256> own; // the part's records among the next ones
  for (std::size_t begin = 0; begin < records.count; begin += own.size()) {
    const std::size_t end = std::min(begin + own.size(), records.count);
    for (std::size_t i = begin; i < end; i += words_per_line) fetch(records, i + own.size());
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) { // without branches, which could not be predicted
      own[count] = static_cast<std::uint32_t>(i);
      count += part_of[i] == part ? 1 : 0;
    }
    for (std::size_t k = 0; k < std::min(count, splats_ahead); ++k)
      to.expect_splat(static_cast<std::size_t>(words.pixels[own[k]]));
    for (std::size_t k = 0; k < count; ++k) {
      if (k + splats_ahead < count)
        to.expect_splat(static_cast<std::size_t>(words.pixels[own[k + splats_ahead]]));
      words.add(own[k], to);
    }
  }
}

// Adds each record to an earlier one of the same path and pixel, if there is one. Most paths have two or
// three records, rarely two of the same pixel.
void SplatFolder::merge(const SplatRecords& records) {
  std::int32_t* const pixels = pixels_of(records);
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
  const Words words(records);
  for (std::size_t i = 0; i < records.count; ++i) {
    if (i + splats_ahead < records.count && words.pixels[i + splats_ahead] != none)
      film.expect_splat(static_cast<std::size_t>(words.pixels[i + splats_ahead]));
    if (words.pixels[i] == none) continue;
    if (words.is_finite(i))
      words.add(i, film);
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
  std::int32_t* const pixels = pixels_of(records);
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
