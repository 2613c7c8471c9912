// What a device hands over of light paths and bidirectional paths: records of splats, folded into the film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/film.h"

namespace phlux::film {

/// One batch's records as the device wrote them: arrays of `capacity` words each, of which the first `count`
/// hold (kernels/scene/scene_data.h, RecordWords).
struct SplatRecords {
  float* words = nullptr;
  std::size_t capacity = 0, count = 0;
  std::size_t paths = 0; ///< of the batch: its records name paths below that
};

/// Adds up what each path brought to each pixel before it goes to the film, which wants the squares of that.
class SplatFolder {
public:
  /// Changes the records. The film uses splats. Returns the paths that brought a pixel what is not finite,
  /// once for each such pixel; the film does without that.
  std::vector<std::size_t> fold(const SplatRecords& records, Film& film);

  /// For records that tell techniques apart, before fold(): hands each to the film's techniques, weights it,
  /// and takes out those to the paths' own pixels, which the film has already. What is not finite is left to
  /// fold().
  static void fold_techniques(const SplatRecords& records, Film& film);

private:
  void merge(const SplatRecords& records);

  struct PathSoFar {
    std::uint64_t pixels = 0; ///< a bit for each pixel that it has been to, which pixels share
    std::int32_t last = -1;   ///< its latest record, -1: none
  };
  std::vector<PathSoFar> paths_;
  std::vector<std::int32_t> earlier_; ///< per record: the one before of the same path, -1: none
};

} // namespace phlux::film
