// Records of splats, which devices write for light and bidirectional paths, and their addition to the film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"

namespace phlux::film {

/// The records of one batch: arrays of `capacity` words each, of which the first `count` are used
/// (kernels/scene/scene_data.h, RecordWords).
struct SplatRecords {
  float* words = nullptr;
  std::size_t capacity = 0, count = 0;
  std::size_t paths = 0; ///< of the batch; records have path indices below it
};

/// Divides the splats of several batches among the parts of a film.
class DividedSplats {
public:
  static constexpr std::size_t most_parts = 255;
  /// Forgets what was divided before, and makes room for these batches. 1 <= parts <= most_parts.
  void begin(std::span<const SplatRecords> batches, const Film& film, std::size_t parts);
  /// Finds the parts of the records of a batch that SplatFolder::merge() has summed. Those that are not
  /// finite are left out; returns their paths. Different batches may be divided at the same time.
  std::vector<std::size_t> divide(std::size_t batch);
  /// Adds the splats of a batch that are in a part, in the order of their records.
  void add(std::size_t batch, std::size_t part, Film::Part& to) const;

private:
  static constexpr std::uint8_t no_part = most_parts;
  std::span<const SplatRecords> batches_;
  double rows_per_pixel_ = 1.0;           // rows of tiles
  std::vector<std::uint8_t> part_of_row_; // of tiles
  std::vector<std::size_t> first_;        // of each batch in part_of_
  std::vector<std::uint8_t> part_of_;     // each record
};

/// Sums the splats of each path to each pixel and adds the sums to the film, which needs their squares.
class SplatFolder {
public:
  /// Sums the records of each path and pixel, in the first of them. After fold_techniques().
  void merge(const SplatRecords& records);

  /// Adds records that merge() has summed to a film that uses splats. Sums that are not finite are left out;
  /// returns their paths.
  static std::vector<std::size_t> fold(const SplatRecords& records, Film& film);
  /// For records with techniques, before fold(): adds each to the film's techniques, multiplies it by its
  /// weight, and removes those of the paths' own pixels, which the film already has. Values that are not
  /// finite are left to fold().
  static void fold_techniques(const SplatRecords& records, Film& film);

private:
  struct PathSoFar {
    std::uint64_t pixels = 0; ///< bit_of() its records' pixels
    std::int32_t last = -1;   ///< its latest record, -1: none
  };
  std::vector<PathSoFar> paths_;
  std::vector<std::int32_t> earlier_; ///< per record: the previous one of the same path, -1: none
};

} // namespace phlux::film
