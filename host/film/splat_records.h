// Records of splats, which devices write for light and bidirectional paths, and their addition to the film.
#pragma once

#include <cstddef>
#include <cstdint>
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
